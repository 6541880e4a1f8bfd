#!/usr/bin/env python3
"""Writes the C++ blocks of a Markdown page, in order, to one source file."""
import re
import sys
from pathlib import Path

page, source = map(Path, sys.argv[1:])
blocks = re.findall(r"^```cpp\n(.*?)^```", page.read_text(encoding="utf-8"), re.M | re.S)
if not blocks:
    sys.exit(f"{page}: no code")
source.write_text("\n".join(blocks), encoding="utf-8")
