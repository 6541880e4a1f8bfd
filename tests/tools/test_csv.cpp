// Tables of numbers in and out, and output files that appear whole or not at all.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "schemes/errors.h"
#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/tools/cli_run.h"
#include "tools/cli/csv.h"
#include "tools/cli/output_file.h"

namespace shaolin::test {
namespace {

namespace fs = std::filesystem;

CsvTable parse(const std::string& text, std::initializer_list<std::size_t> columns = {2, 3}) {
  std::istringstream stream(text);
  return read_csv(stream, "r.csv", columns);
}

std::vector<double> row(const CsvTable& table, std::size_t i) { return {table.row(i).begin(), table.row(i).end()}; }

/// The message that the call ends with.
template <class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no error)";
}

void check_contains(const std::string& text, const std::string& part) {
  CAPTURE(text, part);
  CHECK(text.find(part) != std::string::npos);
}

void check_starts(const std::string& text, const std::string& start) {
  CAPTURE(text, start);
  CHECK(text.starts_with(start));
}

void check_error(const std::string& text, int line, const std::vector<std::string>& words) {
  const std::string message = message_of([&] { parse(text); });
  INFO(text);
  CAPTURE(message);
  CHECK(message.starts_with("r.csv:" + std::to_string(line) + ": "));
  for (const std::string& word : words) CHECK(message.find(word) != std::string::npos);
}

}  // namespace

TEST_CASE("Rows are read with or without a header", "[tools][csv]") {
  const CsvTable plain = parse("1,2\n3,4,5\n");
  REQUIRE(plain.row_count() == 2);
  CHECK(plain.header().empty());
  CHECK(row(plain, 0) == std::vector<double>{1, 2});
  CHECK(row(plain, 1) == std::vector<double>{3, 4, 5});

  const CsvTable named = parse("face, u\n1,2\n");
  CHECK(named.header() == std::vector<std::string>{"face", "u"});
  REQUIRE(named.row_count() == 1);
  CHECK(row(named, 0) == std::vector<double>{1, 2});
  CHECK(named.line(0) == 2);

  CHECK(parse("a,b\n").row_count() == 0);
  CHECK(parse("").row_count() == 0);
}

TEST_CASE("Blank lines, CRLF, blanks, a byte order mark and a missing last newline are fine", "[tools][csv]") {
  const CsvTable table = parse("\xEF\xBB\xBF\r\n 1 ,\t2 \r\n\r\n  \t\n+3,-4e0\r\n\n.5,1e-3");
  REQUIRE(table.row_count() == 3);
  CHECK(row(table, 0) == std::vector<double>{1, 2});
  CHECK(row(table, 1) == std::vector<double>{3, -4});
  CHECK(row(table, 2) == std::vector<double>{0.5, 1e-3});
  CHECK(table.line(0) == 2);
  CHECK(table.line(1) == 5);
  CHECK(table.line(2) == 7);
}

TEST_CASE("Infinities and NaN are numbers, with a line for the caller to report", "[tools][csv]") {
  const CsvTable table = parse("nan,1\ninf,-inf\n1e400,Infinity\n");
  REQUIRE(table.row_count() == 3);
  CHECK(std::isnan(table.row(0)[0]));
  CHECK(row(table, 1) == std::vector<double>{infinity, -infinity});
  CHECK(row(table, 2) == std::vector<double>{infinity, infinity});
  CHECK(message_of([&] { table.fail(1, "the direction is not finite"); }) == "r.csv:2: the direction is not finite");
}

TEST_CASE("Rows of another length are errors at their line", "[tools][csv]") {
  check_error("1,2\n3\n", 2, {"1 columns", "expected 2 or 3"});
  check_error("1,2\n\n1,2,3,4\n", 3, {"4 columns", "expected 2 or 3"});
  check_error("1,2,3,\n", 1, {"4 columns"});
  check_error("a,b\n1,2,3,4\n", 2, {"4 columns"});
  check_error("a,b,c,d\n1,2\n", 1, {"4 columns"});
  check_error("a,b,c\n1,2,3\n1,2\n", 3, {"2 columns", "expected 3 as in the header"});
  check_error("a,b\n1,2,3\n", 2, {"3 columns", "expected 2 as in the header"});
  check_error("1;2\n", 1, {"1 columns"});
}

TEST_CASE("Fields that are no numbers are errors at their line", "[tools][csv]") {
  check_error("1,2\n3,four\n", 2, {"column 2", "'four'", "not a number"});
  check_error("1,\n", 1, {"column 2", "''"});
  check_error(",1\n", 1, {"column 1", "''"});
  check_error("1,2\nface,u\n", 2, {"column 1", "'face'"});
  check_error("a,b\nc,d\n", 2, {"'c'"});
  check_error("1,2 3\n", 1, {"'2 3'"});
  check_error("1,0x2\n", 1, {"'0x2'"});
  check_error("# 1,2\n1,2\n", 1, {"'# 1'"});
}

TEST_CASE("A spoilt first row is not taken for a header", "[tools][csv]") {
  check_error("one,2\n1,2\n", 1, {"column 1", "'one'"});
}

TEST_CASE("Integers are checked where they are asked for", "[tools][csv]") {
  const CsvTable table = parse("3,-7\n1.5,nan\n3e9,inf\n");
  CHECK(table.integer(0, 0) == 3);
  CHECK(table.integer(0, 1) == -7);
  check_starts(message_of([&] { table.integer(1, 0); }), "r.csv:2: column 1: 1.5");
  check_starts(message_of([&] { table.integer(1, 1); }), "r.csv:2: column 2: nan");
  check_starts(message_of([&] { table.integer(2, 0); }), "r.csv:3: column 1: ");
  check_starts(message_of([&] { table.integer(2, 1); }), "r.csv:3: column 2: inf");
}

TEST_CASE("CSV files that cannot be read are errors that name the file", "[tools][csv]") {
  const Folder folder;
  const auto message = [&](const fs::path& file) { return message_of([&] { read_csv(file, {2}); }); };
  CHECK(message(folder / "none.csv") == (folder / "none.csv").string() + ": no such file");
  check_contains(message(folder.path()), "is a directory");
  std::ofstream(folder / "binary.csv", std::ios::binary) << "1,2\n" << '\0' << ",4\n";
  check_contains(message(folder / "binary.csv"), "zero bytes");
}

TEST_CASE("A written table reads back bit for bit", "[tools][csv]") {
  const Folder folder;
  const fs::path file = folder / "out.csv";
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-300, 300), mantissa(-1, 1);
  std::vector<double> numbers;
  for (int i = 0; i < 60000; ++i) numbers.push_back(mantissa(random) * std::pow(10, exponent(random)));

  CsvWriter writer(file, "i,x");
  for (std::size_t i = 0; i < numbers.size(); ++i) writer.field(static_cast<int>(i)).field(numbers[i]).end_row();
  writer.commit();

  const CsvTable table = read_csv(file, {2});
  CHECK(table.header() == std::vector<std::string>{"i", "x"});
  REQUIRE(table.row_count() == numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    REQUIRE(table.integer(i, 0) == static_cast<int>(i));
    REQUIRE(table.row(i)[1] == numbers[i]);
  }
}

TEST_CASE("Numbers are written as printf's %.17g, and fields may be empty", "[tools][csv]") {
  const Folder folder;
  const std::vector<double> numbers{0.1, 1, -0.0, 1e22, 1e-7, 123456789.125, 5e-324, 1.0 / 3};
  CsvWriter writer(folder / "out.csv", "a,b,c,d");
  std::string expected = "a,b,c,d\n";
  for (const double x : numbers) {
    writer.field(1).field(x).empty(2).end_row();
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", x);
    expected += std::string("1,") + text + ",,\n";
  }
  writer.empty().field(9007199254740993LL).empty().field(0).end_row();
  expected += ",9007199254740993,,0\n";
  writer.commit();
  CHECK(read_file(folder / "out.csv") == expected);
  CHECK(folder.list() == std::set<std::string>{"out.csv"});
}

TEST_CASE("A table that is not committed leaves nothing behind, and an older file as it was", "[tools][csv]") {
  const Folder folder;
  { CsvWriter(folder / "new.csv", "a").field(1).end_row(); }
  CHECK(folder.list().empty());

  std::ofstream(folder / "old.csv") << "old";
  {
    CsvWriter writer(folder / "old.csv", "a");
    writer.field(1).end_row();
    CHECK(read_file(folder / "old.csv") == "old");
  }
  CHECK(read_file(folder / "old.csv") == "old");
  CHECK(folder.list() == std::set<std::string>{"old.csv"});
}

TEST_CASE("An output file keeps the extension, stays apart from others and takes the target's place", "[tools][csv]") {
  const Folder folder;
  std::ofstream(folder / "image.exr") << "old";
  OutputFile first(folder / "image.exr"), second(folder / "image.exr");
  CHECK(first.path().extension() == ".exr");
  CHECK(first.path().parent_path() == folder.path());
  CHECK(first.path() != second.path());
  std::ofstream(first.path()) << "first";
  std::ofstream(second.path()) << "second";
  first.commit();
  CHECK(read_file(folder / "image.exr") == "first");
  second.commit();
  CHECK(read_file(folder / "image.exr") == "second");
  CHECK(folder.list() == std::set<std::string>{"image.exr"});
}

TEST_CASE("Output through a symbolic link replaces the file that it leads to", "[tools][csv]") {
  const Folder folder;
  fs::create_directory(folder / "inner");
  std::ofstream(folder / "inner/real.csv") << "old";
  fs::create_symlink("inner/real.csv", folder / "link.csv");
  CsvWriter writer(folder / "link.csv", "a");
  writer.commit();
  CHECK(fs::is_symlink(folder / "link.csv"));
  CHECK(read_file(folder / "inner/real.csv") == "a\n");
}

TEST_CASE("A device is written to, not replaced", "[tools][csv]") {
  OutputFile output("/dev/null");
  CHECK(output.path() == "/dev/null");
  output.commit();
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("Targets that cannot be written are errors that name them", "[tools][csv]") {
  const Folder folder;
  const auto message = [](const fs::path& file) { return message_of([&] { OutputFile output(file); }); };
  check_starts(message(folder / "none/out.csv"), (folder / "none/out.csv").string() + ": ");
  check_contains(message(folder / "none/out.csv"), "does not exist");
  check_contains(message(folder.path()), "is a folder");
  check_contains(message(folder / "x/"), "expected the name of a file");
  check_contains(message(""), "expected the name of a file");
  check_contains(message(folder / (std::string(300, 'a') + ".csv")), "cannot be written");
  CHECK(folder.list().empty());
}

TEST_CASE("A full disk is an error, not a short file", "[tools][csv]") {
  if (!fs::exists("/dev/full")) return;
  CsvWriter writer("/dev/full", "a");
  check_starts(message_of([&] { writer.commit(); }), "/dev/full: cannot be written");
}

}  // namespace shaolin::test
