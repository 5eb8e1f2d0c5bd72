#include "gltf/triangle_packing.h"

#include <algorithm>
#include <cstddef>

namespace zerotree::gltf {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Edge = std::array<std::uint32_t, 2>;

constexpr std::uint8_t kHeader = 0xe1;  // triangles, version 1
constexpr std::uint32_t kNothing = 0xffffffff;
// Codes of a corner in four bits.
constexpr unsigned kNextVertex = 0, kBeforeLast = 13, kAfterLast = 14, kExplicit = 15;
// Of a triangle that continues no edge: its first corner is the next new vertex, or explicit.
constexpr std::uint8_t kFirstIsNext = 0xfe, kFirstIsExplicit = 0xff;
// Pairs of corner codes that a triangle's code byte can name. Any table may stand at the end of
// the data; this one is meshoptimizer's. The last two entries cannot be named.
constexpr std::array<std::uint8_t, 16> kCornerPairs = {
    0x00, 0x76, 0x87, 0x56, 0x67, 0x78, 0xa9, 0x86, 0x65, 0x89, 0x68, 0x98, 0x01, 0x69, 0x00, 0x00};
constexpr unsigned kNamedPairs = 14;

// The last 16 of what was pushed.
template <class Item>
class RecentItems {
 public:
  explicit RecentItems(const Item& nothing) { items_.fill(nothing); }

  void push(const Item& item) {
    items_[next_] = item;
    next_ = (next_ + 1) % items_.size();
  }

  // How many were pushed after it; 16 if it is not among them.
  unsigned age(const Item& item) const {
    for (unsigned age = 0; age < items_.size(); ++age)
      if (items_[(next_ - 1 - age) % items_.size()] == item) return age;
    return static_cast<unsigned>(items_.size());
  }

 private:
  std::array<Item, 16> items_;
  std::size_t next_ = 0;
};

class TrianglePacker {
 public:
  void add(const Triangle& triangle) {
    const unsigned edge_age = edges_.age({triangle[0], triangle[1]});
    if (edge_age < 15)
      continue_edge(triangle, edge_age);
    else
      start_anew(triangle);
  }

  std::vector<std::uint8_t> packed() const {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(1 + codes_.size() + data_.size() + kCornerPairs.size());
    bytes.push_back(kHeader);
    bytes.insert(bytes.end(), codes_.begin(), codes_.end());
    bytes.insert(bytes.end(), data_.begin(), data_.end());
    bytes.insert(bytes.end(), kCornerPairs.begin(), kCornerPairs.end());
    return bytes;
  }

 private:
  // The first two corners are an edge of an earlier triangle: only the third must be coded.
  void continue_edge(const Triangle& t, unsigned edge_age) {
    const unsigned corner = third_corner(t[2]);
    codes_.push_back(static_cast<std::uint8_t>(edge_age << 4 | corner));
    if (corner == kExplicit) append_explicit(t[2]);
    if (corner == kNextVertex || corner >= kBeforeLast) vertices_.push(t[2]);
    edges_.push({t[2], t[1]});
    edges_.push({t[0], t[2]});
  }

  unsigned third_corner(std::uint32_t vertex) {
    const unsigned age = vertices_.age(vertex);
    if (age >= 1 && age < kBeforeLast) return age;
    if (take_next(vertex)) return kNextVertex;
    if (vertex + 1 != last_ && vertex != last_ + 1) return kExplicit;
    const bool is_before = vertex + 1 == last_;
    last_ = vertex;
    return is_before ? kBeforeLast : kAfterLast;
  }

  void start_anew(const Triangle& t) {
    // Ages are those before any corner of this triangle is pushed.
    const unsigned age_b = vertices_.age(t[1]), age_c = vertices_.age(t[2]);
    const bool first_is_next = take_next(t[0]);
    const unsigned b = free_corner(t[1], age_b);
    unsigned c = free_corner(t[2], age_c);
    // After an explicit corner, two new ones would read as a restart of the vertex count.
    if (!first_is_next && b == kNextVertex && c == kNextVertex) {
      c = kExplicit;
      --next_vertex_;
    }
    append_free_codes(first_is_next, static_cast<std::uint8_t>(b << 4 | c));
    if (!first_is_next) append_explicit(t[0]);
    if (b == kExplicit) append_explicit(t[1]);
    if (c == kExplicit) append_explicit(t[2]);
    vertices_.push(t[0]);
    if (b == kNextVertex || b == kExplicit) vertices_.push(t[1]);
    if (c == kNextVertex || c == kExplicit) vertices_.push(t[2]);
    edges_.push({t[1], t[0]});
    edges_.push({t[2], t[1]});
    edges_.push({t[0], t[2]});
  }

  unsigned free_corner(std::uint32_t vertex, unsigned age) {
    if (age < 14) return age + 1;
    return take_next(vertex) ? kNextVertex : kExplicit;
  }

  void append_free_codes(bool first_is_next, std::uint8_t pair) {
    const auto end = kCornerPairs.begin() + kNamedPairs;
    const auto named = std::find(kCornerPairs.begin(), end, pair);
    if (first_is_next && named != end) {
      codes_.push_back(static_cast<std::uint8_t>(0xf0 | (named - kCornerPairs.begin())));
      return;
    }
    codes_.push_back(first_is_next ? kFirstIsNext : kFirstIsExplicit);
    data_.push_back(pair);
  }

  bool take_next(std::uint32_t vertex) {
    if (vertex != next_vertex_) return false;
    ++next_vertex_;
    return true;
  }

  // The signed difference to the last explicit vertex, in groups of seven bits.
  void append_explicit(std::uint32_t vertex) {
    const std::uint32_t difference = vertex - last_;
    std::uint32_t rest = difference << 1 ^ (difference >> 31 ? 0xffffffff : 0);
    for (; rest > 127; rest >>= 7) data_.push_back(static_cast<std::uint8_t>(rest | 128));
    data_.push_back(static_cast<std::uint8_t>(rest));
    last_ = vertex;
  }

  RecentItems<Edge> edges_{{kNothing, kNothing}};
  RecentItems<std::uint32_t> vertices_{kNothing};
  std::uint32_t next_vertex_ = 0, last_ = 0;
  std::vector<std::uint8_t> codes_, data_;
};

}  // namespace

std::vector<std::uint8_t> pack_triangles(std::span<const Triangle> triangles) {
  TrianglePacker packer;
  for (const Triangle& triangle : triangles) packer.add(triangle);
  return packer.packed();
}

}  // namespace zerotree::gltf
