// Decodes a stream with the installed C++ wrapper: consumer STREAM.zt
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>
#include <zerotree/zerotree.hpp>

static_assert(ZT_VERSION_MAJOR == 0 && ZT_VERSION_MINOR >= 1 && ZT_VERSION_PATCH >= 0);

namespace {

int fail(const char* what) {
  std::fprintf(stderr, "consumer.cpp: %s\n", what);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return fail("usage: consumer STREAM.zt");
  if (std::string_view(zt_version()) != ZT_VERSION)
    return fail("header and library differ in version");
  std::ifstream file(argv[1], std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  zerotree::Decoder decoder;
  if (decoder.feed(bytes) != ZT_DONE) return fail("the stream is not whole");
  zerotree::SurfaceSamples surface;
  if (decoder.reconstruct(decoder.info().levels, surface) != ZT_OK || surface.indices.empty())
    return fail("the surface was not reconstructed");
  std::printf("zerotree %s: %zu triangles\n", zt_version(), surface.indices.size() / 3);
  return 0;
}
