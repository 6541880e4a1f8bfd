#pragma once
/// A folder of pages, tables and pictures.
#include <filesystem>
#include <functional>
#include <ostream>

#include "tools/cli/png.h"

namespace shaolin {

/// Makes the folder if it is not there. Throws InputError if that fails.
void make_report_folder(const std::filesystem::path& folder);

/// Writes a text file, whole or not at all, and says so on stdout. Throws InputError if that fails.
void write_page(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/// Writes a PNG file, whole or not at all. Throws as write_png() does.
void write_picture(const std::filesystem::path& file, const Picture& picture);

}  // namespace shaolin
