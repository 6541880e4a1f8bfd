#include "tools/cli/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>

#include <vector>

namespace shaolin {
namespace {

/// A channel: its name in the file, its type, and its place in the first pixel.
struct Channel {
  const char* name;
  Imf::PixelType type;
  const void* first;
};

std::vector<Channel> channels(const Pixel& first, bool instances) {
  std::vector<Channel> list{{"R", Imf::FLOAT, &first.color[0]},
                            {"G", Imf::FLOAT, &first.color[1]},
                            {"B", Imf::FLOAT, &first.color[2]},
                            {"A", Imf::FLOAT, &first.alpha},
                            {"Z", Imf::FLOAT, &first.z},
                            {"N.X", Imf::FLOAT, &first.normal[0]},
                            {"N.Y", Imf::FLOAT, &first.normal[1]},
                            {"N.Z", Imf::FLOAT, &first.normal[2]},
                            {"P.X", Imf::FLOAT, &first.position[0]},
                            {"P.Y", Imf::FLOAT, &first.position[1]},
                            {"P.Z", Imf::FLOAT, &first.position[2]},
                            {"uv.U", Imf::FLOAT, &first.uv[0]},
                            {"uv.V", Imf::FLOAT, &first.uv[1]},
                            {"face", Imf::UINT, &first.face},
                            {"level", Imf::UINT, &first.level}};
  if (instances) list.push_back({"instance", Imf::UINT, &first.instance});
  return list;
}

}  // namespace

void write_exr(const std::filesystem::path& file, const Image& image, const ExrNotes& notes, int threads) {
  Imf::Header header(image.size.width, image.size.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.insert("camera", Imf::StringAttribute(notes.camera));
  header.insert("scheme", Imf::StringAttribute(notes.scheme));

  Imf::FrameBuffer frame_buffer;
  for (const Channel& channel : channels(image.pixels.front(), notes.instances)) {
    header.channels().insert(channel.name, Imf::Channel(channel.type));
    // The library's slices are writable because reading uses them, too.
    char* const base = const_cast<char*>(static_cast<const char*>(channel.first));
    frame_buffer.insert(channel.name, Imf::Slice(channel.type, base, sizeof(Pixel), sizeof(Pixel) * image.size.width));
  }
  Imf::setGlobalThreadCount(threads > 1 ? threads : 0);  // 0: compress in this thread
  Imf::OutputFile output(file.c_str(), header, threads);
  output.setFrameBuffer(frame_buffer);
  output.writePixels(image.size.height);
}

}  // namespace shaolin
