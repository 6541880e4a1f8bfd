#include "tools/bench/report_folder.h"

#include <cstdio>
#include <fstream>

#include "schemes/errors.h"
#include "tools/cli/output_file.h"

namespace shaolin {

void make_report_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError("cannot make the folder: " + error.message(), folder.string());
}

void write_page(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  OutputFile output(file);
  std::ofstream stream(output.path());
  write(stream);
  stream.close();
  if (!stream) throw InputError("cannot write the report", file.string());
  output.commit();
  std::printf("wrote %s\n", file.c_str());
}

void write_picture(const std::filesystem::path& file, const Picture& picture) {
  OutputFile output(file);
  write_png(output.path(), picture);
  output.commit();
}

}  // namespace shaolin
