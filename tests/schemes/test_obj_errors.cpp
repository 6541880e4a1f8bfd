// Everything malformed in an OBJ file is an error with file, line, the offending word and what was expected.
#include <filesystem>
#include <fstream>
#include <string>

#include "schemes/obj.h"
#include "tests/catch.h"
#include "tests/schemes/obj_text.h"

namespace shaolin::obj_text {

TEST_CASE("Lines are counted through continued lines and comments", "[schemes][obj]") {
  check_error("v 0 0 0\nv 1 \\\n 0 \\\n 0\n# c \\\nv 0 x 0\n", 6, {"'x'"});
  check_error("v 0 0 0\nv 1 \\\n 0 \\\n y\n", 2, {"'y'"});
}

TEST_CASE("Malformed vertices are errors at their line", "[schemes][obj]") {
  check_error("v 0 0 0\nv 1 zero 0\n", 2, {"'zero'", "not a number"});
  check_error("v 1 2,5 0\n", 1, {"'2,5'"});
  check_error("v 0x10 0 0\n", 1, {"'0x10'"});
  check_error("v +-1 0 0\n", 1, {"'+-1'"});
  check_error("v 1.0.0 0 0\n", 1, {"'1.0.0'"});
  check_error("v 0 0\n", 1, {"2 coordinates", "expected 3"});
  check_error("v\n", 1, {"0 coordinates"});
  check_error("v 0 0 nan\n", 1, {"'nan'", "not finite"});
  check_error("v 0 -inf 0\n", 1, {"'-inf'", "not finite"});
  check_error("v 1e999 0 0\n", 1, {"'1e999'", "not finite"});
}

TEST_CASE("Malformed faces are errors at their line", "[schemes][obj]") {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  check_error(points + "f 1 2\n", 4, {"2 corners", "at least 3"});
  check_error(points + "f\n", 4, {"0 corners"});
  check_error(points + "f 1 2 three\n", 4, {"'three'"});
  check_error(points + "f 1 2 3.5\n", 4, {"'3.5'"});
  check_error(points + "f 1/1 2/1 3/x\n", 4, {"'3/x'"});
  check_error(points + "f 1/1/1/1 2 3\n", 4, {"'1/1/1/1'"});
  check_error(points + "f 1 2 /3\n", 4, {"'/3'"});
  check_error(points + "f 1 2 3\nf 1 0 2\n", 5, {"index 0", "'0'", "count from 1"});
  check_error(points + "f 1 2 3\n\nf 1 2 4\nt corner 1/1/0 0 1\n", 6, {"index 4", "out of range", "3 vertices"});
  check_error(points + "f -1 -2 -4\nv 0 0 0\n", 4, {"'-4'", "3 vertices so far"});
  check_error(points + "f 1 2 99999999999\n", 4, {"'99999999999'", "out of range"});
  check_error(points + "f 1 2 99999999999999999999999\n", 4, {"out of range"});
  check_error("f 1 2 3\n", 1, {"index 1", "out of range", "0 vertices"});
}

TEST_CASE("Tags that are cut short are errors at their line", "[schemes][obj]") {
  for (const std::string tag : {"t",
                                "t crease",
                                "t crease 2/1/0",
                                "t crease 2/1/0 0",
                                "t crease 2/1/0 0 1",
                                "t crease 2/1 0 1 2",
                                "t crease 2 0 1 2",
                                "t crease 0 1 2",
                                "t crease 1/1/0 0 2",
                                "t crease 2/0/0 0 1",
                                "t crease 4/2/0 0 1 2 3 1 1",
                                "t crease 2/1/1 0 1 2 x",
                                "t crease 2/1/-1 0 1 2",
                                "t crease 2/1/0/0 0 1 2",
                                "t crease //0 0 1 2",
                                "t crease 9999999999999/1/0 0 1 2",
                                "t corner 1/1/0 3",
                                "t corner 0/1/0 1",
                                "t corner 1/0/0 1",
                                "t corner 3/2/0 0 1 2 1 1",
                                "t hole 2/0/0 0",
                                "t hole 0/0/0",
                                "t hole 1/1/0 0 1",
                                "t interpolateboundary 1/0/0",
                                "t interpolateboundary 0/0/0",
                                "t interpolateboundary 2/0/0 1 1",
                                "t facevaryinginterpolateboundary 1/0/0",
                                "t creasemethod 0/0/1",
                                "t creasemethod chaikin",
                                "t smoothtriangles 0/0/1",
                                "t scheme 0/0/1",
                                "t scheme 0/0/0",
                                "t cone 1/0/0",
                                "t vertexedit 2/1/1 0 1 0.5",
                                "t faceedit 1/0/1 0"}) {
    CAPTURE(tag);
    check_tag_error(tag, {"cut short"});
  }
}

TEST_CASE("Tags with wrong content are errors at their line", "[schemes][obj]") {
  check_tag_error("t creese 2/1/0 0 1 2", {"unknown tag 'creese'"});
  check_tag_error("t crease 2/1/0 0 1 2 3", {"'crease'", "'3'", "'2/1/0'"});
  check_tag_error("t crease 2/1/0 0 b 2", {"'b'", "not an integer"});
  check_tag_error("t crease 2/1/0 0 1.5 2", {"'1.5'", "not an integer"});
  check_tag_error("t crease 2/1/0 0 1 sharp", {"'sharp'", "not a number"});
  check_tag_error("t crease 2/1/0 0 4 2", {"crease", "vertex 4", "0 to 3"});
  check_tag_error("t crease 2/1/0 -1 0 2", {"vertex -1", "0 to 3"});
  check_tag_error("t crease 2/1/0 0 5000000000 2", {"'5000000000'", "out of range"});
  check_tag_error("t corner 1/1/0 4 2", {"corner", "vertex 4", "0 to 3"});
  check_tag_error("t hole 1/0/0 4", {"hole", "face 4", "0 to 3"});
  check_tag_error("t hole 1/0/0 -1", {"face -1"});
  check_tag_error("t interpolateboundary 1/0/0 3", {"mode 3"});
  check_tag_error("t interpolateboundary 1/0/0 -1", {"mode -1"});
  check_tag_error("t creasemethod 0/0/1 chalkin", {"'chalkin'", "normal or chaikin"});
  check_tag_error("t smoothtriangles 0/0/1 loop", {"'loop'", "catmark or smooth"});
}

TEST_CASE("A tag's index is reported at its own line, wherever that is", "[schemes][obj]") {
  check_error("t corner 1/1/0 0 1\nt corner 1/1/0 7 1\n" + tetrahedron, 2, {"vertex 7"});
  check_error("t hole 1/0/0 0\n" + tetrahedron + "t hole 2/0/0 1 9\n", 10, {"face 9"});
}

TEST_CASE("A cone's vertex must exist", "[schemes][obj]") { check_tag_error("t cone 1/0/0 9", {"cone", "vertex 9"}); }

TEST_CASE("Tags that are not supported yet say so", "[schemes][obj]") {
  check_tag_error("t vertexedit 2/1/3 0 0 0.5 add P value", {"'vertexedit'", "not supported yet"});
  check_tag_error("t edgeedit 1/1/1 0 0.5 add", {"'edgeedit'", "not supported yet"});
  check_tag_error("t faceedit 1/0/0 0", {"'faceedit'", "not supported yet"});
}

TEST_CASE("Unknown statements are errors, short and printable", "[schemes][obj]") {
  check_error(tetrahedron + "w 1 2 3\n", 9, {"unknown statement 'w'"});
  check_error("<html>\n", 1, {"'<html>'"});
  check_error("\x01\x02\xff\n", 1, {'\'' + std::string(3, '?') + '\''});
  check_error(std::string(1000, 'z'), 1, {std::string(40, 'z') + "...'"});
}

TEST_CASE("A mesh without faces is an error", "[schemes][obj]") {
  check_error("", 1, {"empty"});
  check_error("# nothing\n\n", 2, {"empty"});
  check_error("v 0 0 0\nv 1 0 0\nv 0 1 0\n", 3, {"without a face"});
}

TEST_CASE("Files that cannot be read or are no text are errors that name the file", "[schemes][obj]") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "shaolin_test_obj_files";
  std::filesystem::create_directories(folder);
  check_contains(message_of_file(folder / "missing.obj"), "no such file");
  check_contains(message_of_file(folder), "is a directory");
  std::ofstream(folder / "binary.obj", std::ios::binary) << tetrahedron << '\0' << "v 1 2 3\n";
  check_contains(message_of_file(folder / "binary.obj"), "zero bytes");
  std::ofstream(folder / "bad.obj") << "v 0 0 zero\n";
  check_starts(message_of_file(folder / "bad.obj"), (folder / "bad.obj").string() + ":1: ");
  std::ofstream(folder / "good.obj") << tetrahedron;
  CHECK(read_obj(folder / "good.obj").face_count() == 4);
  std::filesystem::remove_all(folder);
}

}  // namespace shaolin::obj_text
