#pragma once
// What an EXR file holds, whatever its channels are.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "schemes/vec3.h"

namespace shaolin::test {

inline constexpr std::uint32_t none = 4294967295u;

/// An EXR file's channels, whatever they are: each value in four bytes, as FLOAT or UINT.
struct ExrImage {
  explicit ExrImage(const std::filesystem::path& file) {
    Imf::InputFile input(file.c_str());
    const auto window = input.header().dataWindow();
    width = window.max.x - window.min.x + 1;
    height = window.max.y - window.min.y + 1;
    Imf::FrameBuffer frame_buffer;
    const Imf::ChannelList& list = input.header().channels();
    for (auto channel = list.begin(); channel != list.end(); ++channel) {
      types[channel.name()] = channel.channel().type;
      auto& values = channels[channel.name()];
      values.resize(static_cast<std::size_t>(width) * height);
      frame_buffer.insert(channel.name(), Imf::Slice(channel.channel().type, reinterpret_cast<char*>(values.data()), 4,
                                                     4 * static_cast<std::size_t>(width)));
    }
    input.setFrameBuffer(frame_buffer);
    input.readPixels(window.min.y, window.max.y);
  }

  std::uint32_t id(const std::string& channel, std::size_t pixel) const { return channels.at(channel).at(pixel); }
  float value(const std::string& channel, std::size_t pixel) const {
    float number;
    std::memcpy(&number, &channels.at(channel).at(pixel), sizeof(number));
    return number;
  }
  Vec3 vector(const std::string& layer, std::size_t pixel) const {
    return {value(layer + ".X", pixel), value(layer + ".Y", pixel), value(layer + ".Z", pixel)};
  }
  std::size_t size() const { return static_cast<std::size_t>(width) * height; }

  int width, height;
  std::map<std::string, Imf::PixelType> types;
  std::map<std::string, std::vector<std::uint32_t>> channels;
};

}  // namespace shaolin::test
