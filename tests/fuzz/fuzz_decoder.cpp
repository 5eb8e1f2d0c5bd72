// All functions of zerotree.h on any bytes, in any order: an entry point of libFuzzer. What the
// header promises is checked; a broken promise ends the process.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "fuzz_bases.h"
#include "fuzz_caller.h"
#include "fuzz_plan.h"
#include "zerotree/zerotree.h"

namespace zerotree::fuzz {
namespace {

constexpr std::uint64_t kMostMemory = std::uint64_t{64} << 20;
// So large a step is no mesh's; products with it may overflow.
constexpr float kLargestSaneStep = 1e10f;

bool is_finite(const std::array<float, 3>& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

/// A request to zt_reconstruct_for that is not finished; its buffers stay until it is.
struct Request {
  std::int32_t level;
  std::uint32_t vertices;
  std::unique_ptr<ExactVectors> positions, normals;
};

class FuzzRun {
 public:
  explicit FuzzRun(std::span<const std::uint8_t> input)
      : bytes_(input),
        plan_(FuzzPlan::read(bytes_)),
        random_(plan_.seed + 1u),
        allocator_(plan_.failing) {}

  void run() {
    make_decoder();
    if (!decoder_) {
      EXPECT_THAT(allocator_.has_failed());
      return;
    }
    for (std::size_t step = 0; !is_finished_ && step < kMostSteps; ++step)
      this->step(plan_.steps[step % FuzzPlan::kSteps]);
    finish_request();
    if (!bytes_.empty()) feed(bytes_.size());
    check_state();
    for (const std::int32_t level : {0, 1, zt_level()}) reconstruct(level, true, true, 12);
    check_measures();
    zt_free(decoder_);
  }

 private:
  static constexpr std::size_t kMostSteps = 64;

  std::int32_t zt_level() const {
    zt_info info;
    zt_get_info(decoder_, &info, sizeof info);
    return info.levels;
  }

  std::uint8_t take_byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t byte = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return byte;
  }

  zt_options options() {
    zt_options options{};
    options.struct_size = sizeof options;
    constexpr std::array<std::uint64_t, 4> kMostVertices = {200000, 20000, 2000, 200};
    options.max_vertices = kMostVertices[plan_.limits & 3];
    options.max_memory = kMostMemory;
    options.max_levels = (plan_.limits >> 2 & 3) == 0 ? 8 : 2 * (plan_.limits >> 2 & 3);
    options.allocator = allocator_.functions();
    if (plan_.workers >= 2) options.jobs = {&run_shuffled, &random_, plan_.workers % 8u};
    return options;
  }

  FuzzBase hostile_base() {
    FuzzBase base;
    const std::size_t vertices = take_byte() % 16u, triangles = take_byte() % 24u;
    for (std::size_t i = 0; i < 3 * triangles; ++i) {
      const std::uint8_t index = take_byte();
      base.indices.push_back(index == 0xff ? 0xffffffffu : index);
    }
    base.positions.resize(3 * vertices);
    return base;
  }
  void take_positions(FuzzBase& base) {
    for (float& x : base.positions) {
      const std::uint32_t high = take_byte(), low = take_byte();
      const std::uint32_t bits = high << 24 | low << 16;
      std::memcpy(&x, &bits, sizeof x);
    }
  }

  void make_decoder() {
    const zt_options options = this->options();
    const auto choice =
        static_cast<BaseChoice>(plan_.base % static_cast<unsigned>(BaseChoice::count));
    if (choice == BaseChoice::embedded) {
      find_sane_step();
      decoder_ = zt_create(&options);
      return;
    }
    is_external_ = true;
    FuzzBase base;
    if (choice <= BaseChoice::last_known)
      base = fuzz_base(static_cast<int>(choice) - static_cast<int>(BaseChoice::first_known));
    else
      base = choice == BaseChoice::hostile ? hostile_base() : fuzz_base(0);
    is_hostile_ = choice > BaseChoice::last_known;
    if (is_hostile_) take_positions(base);
    find_sane_step();
    const std::size_t vertices = base.positions.size() / 3;
    const std::size_t stride = 12 + plan_.seed % 5;
    std::unique_ptr<unsigned char[]> positions(
        new unsigned char[std::max<std::size_t>(vertices, 1) * stride]);
    for (std::size_t v = 0; v < vertices; ++v)
      std::memcpy(&positions[v * stride], &base.positions[3 * v], 12);
    // Never null, whatever there is of it.
    base.indices.reserve(1);
    const std::int32_t levels = plan_.levels == 0xff ? -1 : plan_.levels % 10;
    decoder_ = zt_create_for_base(
        positions.get(), stride, static_cast<std::uint32_t>(vertices), base.indices.data(),
        static_cast<std::uint32_t>(base.indices.size() / 3), levels, &options);
  }

  /// Whether the step in the stream's header, whose first byte is the next one, is that of a mesh.
  void find_sane_step() {
    const std::size_t place = is_external_ ? 5 : 6;
    if (bytes_.size() < place + 2) return;
    const std::uint32_t bits = static_cast<std::uint32_t>(bytes_[place]) << 16 |
                               static_cast<std::uint32_t>(bytes_[place + 1]) << 24;
    float step;
    std::memcpy(&step, &bits, sizeof step);
    has_sane_step_ = !(step > kLargestSaneStep);
  }

  // --- what can be done ---

  void step(std::uint8_t code) {
    const unsigned detail = code >> 4;
    const auto level = static_cast<std::int32_t>(detail % 8) - (detail == 15 ? 8 : 0);
    const std::size_t stride = 12 + random_() % 20;
    switch (code & 15) {
      case 0:
      case 1:
      case 2:
      case 3:
        feed(std::size_t{1} << detail);
        break;
      case 4:
        feed(detail);
        break;
      case 5:
        feed_for(std::size_t{64} << detail, static_cast<std::uint32_t>(detail) * 20);
        break;
      case 6:
        reconstruct(level, true, true, stride);
        break;
      case 7:
        reconstruct(level, detail % 2 == 0, detail % 2 == 1, stride);
        break;
      case 8:
      case 9:
        go_on(level, stride, detail % 3);
        break;
      case 10:
        drop_request();
        go_on(level, stride, 0);
        break;
      case 11:
        check_indices<std::uint32_t>(level);
        break;
      case 12:
        check_indices<std::uint16_t>(level);
        break;
      case 13:
        check_measures();
        break;
      case 14:
        check_short_info(detail * 6);
        check_prefix_errors();
        break;
      default:
        check_state();
        finish_request();
        break;
    }
  }

  void feed(std::size_t size) {
    size = std::min(size, bytes_.size());
    // Exactly sized, so that a read beyond is seen.
    const std::unique_ptr<std::uint8_t[]> piece(new std::uint8_t[size]);
    std::copy_n(bytes_.begin(), size, piece.get());
    note_status(zt_feed(decoder_, piece.get(), size));
    bytes_ = bytes_.subspan(size);
    is_finished_ = bytes_.empty();
  }

  void feed_for(std::size_t size, std::uint32_t budget) {
    size = std::min(size, bytes_.size());
    std::size_t taken = size + 1;
    note_status(zt_feed_for(decoder_, bytes_.data(), size, budget, &taken));
    EXPECT_THAT(taken <= size && (taken > 0 || size == 0));
    bytes_ = bytes_.subspan(taken);
    is_finished_ = bytes_.empty();
  }

  void note_status(zt_status status) {
    EXPECT_THAT(status == zt_get_status(decoder_));
    EXPECT_THAT(last_status_ != ZT_DONE || status == ZT_DONE);
    EXPECT_THAT(last_status_ != ZT_BROKEN || status == ZT_BROKEN);
    last_status_ = status;
  }

  void check_state() {
    const zt_status status = zt_get_status(decoder_);
    note_status(status);
    EXPECT_THAT((status == ZT_BROKEN) == (zt_reason(decoder_)[0] != 0));
    zt_info info;
    zt_get_info(decoder_, &info, sizeof info);
    EXPECT_THAT(info.memory == allocator_.held());
    EXPECT_THAT(info.memory <= 2 * kMostMemory);
    EXPECT_THAT(status != ZT_BROKEN || info.base_ready == 0);
    EXPECT_THAT(status != ZT_DONE || info.base_ready == 1);
    EXPECT_THAT(info.base_ready == 1 || zt_vertex_count(decoder_, 0) == 0);
    if (info.base_ready == 0) return;
    EXPECT_THAT(info.levels >= 0 && info.levels <= 8 && info.detailed_levels <= info.levels);
    EXPECT_THAT(zt_vertex_count(decoder_, 0) == info.base_vertex_count);
    EXPECT_THAT(zt_triangle_count(decoder_, 0) == info.base_triangle_count);
    EXPECT_THAT(zt_vertex_count(decoder_, info.levels) <= 200000);
    EXPECT_THAT(zt_vertex_count(decoder_, info.levels + 1) == 0);
    EXPECT_THAT(zt_vertex_count(decoder_, -1) == 0);
  }

  /// What a request for `level` must answer if nothing goes wrong in it.
  void check_answer(zt_result result, std::int32_t level) {
    zt_info info;
    zt_get_info(decoder_, &info, sizeof info);
    if (result == ZT_OUT_OF_MEMORY) EXPECT_THAT(allocator_.has_failed());
    if (result == ZT_BROKEN_STREAM) EXPECT_THAT(zt_get_status(decoder_) == ZT_BROKEN);
    if (result == ZT_NOT_READY) EXPECT_THAT(info.base_ready == 0);
    if (result == ZT_INVALID_ARGUMENT) EXPECT_THAT(level < 0 || level > info.levels);
    // A request may find out that an external base is no surface.
    note_status(zt_get_status(decoder_));
  }

  void check_vectors(const Request& request) const {
    for (std::uint32_t v = 0; v < request.vertices; ++v) {
      if (request.positions && has_sane_step_ && !is_hostile_)
        EXPECT_THAT(is_finite(request.positions->get(v)));
      if (!request.normals) continue;
      const auto n = request.normals->get(v);
      EXPECT_THAT(std::abs(std::hypot(n[0], n[1], n[2]) - 1.0f) < 1e-4f);
    }
  }

  Request make_request(std::int32_t level, bool positions, bool normals, std::size_t stride) {
    Request request{level, zt_vertex_count(decoder_, level), nullptr, nullptr};
    if (positions) request.positions = std::make_unique<ExactVectors>(request.vertices, stride);
    if (normals) request.normals = std::make_unique<ExactVectors>(request.vertices, stride + 1);
    return request;
  }

  static void* data_of(const std::unique_ptr<ExactVectors>& vectors) {
    return vectors ? vectors->data() : nullptr;
  }
  static std::size_t stride_of(const std::unique_ptr<ExactVectors>& vectors) {
    return vectors ? vectors->stride() : 0;
  }

  void reconstruct(std::int32_t level, bool positions, bool normals, std::size_t stride) {
    const Request request = make_request(level, positions, normals, stride);
    const zt_result result =
        zt_reconstruct(decoder_, level, data_of(request.positions), stride_of(request.positions),
                       data_of(request.normals), stride_of(request.normals), request.vertices);
    EXPECT_THAT(result != ZT_UNFINISHED);
    check_answer(result, level);
    if (result == ZT_OK) check_vectors(request);
  }

  /// Works for `budget` microseconds on the request there is, or on a new one.
  void go_on(std::int32_t level, std::size_t stride, std::uint32_t budget) {
    if (request_ && zt_vertex_count(decoder_, request_->level) != request_->vertices)
      drop_request();
    if (!request_) request_ = std::make_unique<Request>(make_request(level, true, true, stride));
    const zt_result result = zt_reconstruct_for(
        decoder_, request_->level, data_of(request_->positions), stride_of(request_->positions),
        data_of(request_->normals), stride_of(request_->normals), request_->vertices, budget);
    check_answer(result, request_->level);
    if (result == ZT_OK) check_vectors(*request_);
    if (result != ZT_UNFINISHED) request_.reset();
  }
  /// Another request in between, so that a new one with buffers at the same place begins anew.
  void drop_request() {
    if (request_)
      zt_reconstruct_for(decoder_, request_->level, nullptr, 0, nullptr, 0, request_->vertices, 0);
    request_.reset();
  }
  void finish_request() {
    for (int slice = 0; request_ && slice < 10; ++slice) go_on(0, 12, 100000);
    drop_request();
  }

  template <class Index>
  void check_indices(std::int32_t level) {
    const std::uint32_t triangles = zt_triangle_count(decoder_, level);
    const std::uint32_t vertices = zt_vertex_count(decoder_, level);
    const std::unique_ptr<Index[]> indices(new Index[std::size_t{3} * triangles]);
    const zt_result result =
        zt_get_indices(decoder_, level, indices.get(), sizeof(Index), triangles);
    if (sizeof(Index) == 2 && vertices > 65535) {
      EXPECT_THAT(result == ZT_INVALID_ARGUMENT);
      return;
    }
    check_answer(result, level);
    if (result != ZT_OK) return;
    EXPECT_THAT(std::all_of(indices.get(), indices.get() + std::size_t{3} * triangles,
                            [&](Index index) { return index < vertices; }));
  }

  void check_measures() {
    std::array<float, 3> low, high;
    zt_result result = zt_get_bounds(decoder_, low.data(), high.data());
    check_answer(result, 0);
    if (result == ZT_OK && has_sane_step_ && !is_hostile_)
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_THAT(std::isfinite(low[axis]) && std::isfinite(high[axis]) &&
                    low[axis] <= high[axis]);
    float last = 0.0f;
    const std::int32_t levels = zt_level();
    for (std::int32_t level = 0; level <= levels; ++level) {
      float error = -1.0f;
      result = zt_get_level_error(decoder_, level, &error);
      check_answer(result, level);
      if (result != ZT_OK) return;
      if (has_sane_step_ && !is_hostile_)
        EXPECT_THAT(std::isfinite(error) && (level == 0 || error <= last));
      last = error;
    }
    std::int32_t chosen = -1;
    result = zt_choose_level(decoder_, 0.01f, &chosen);
    check_answer(result, 0);
    EXPECT_THAT(result != ZT_OK || (chosen >= 0 && chosen <= levels));
  }

  void check_short_info(std::size_t size) {
    zt_info whole;
    zt_get_info(decoder_, &whole, sizeof whole);
    const std::unique_ptr<unsigned char[]> part(new unsigned char[size]);
    zt_get_info(decoder_, reinterpret_cast<zt_info*>(part.get()), size);
    EXPECT_THAT(std::memcmp(part.get(), &whole, std::min(size, sizeof whole)) == 0);
  }

  void check_prefix_errors() {
    const std::array<zt_prefix_error, 3> rows = {{{100, 1.0f}, {200, 0.5f}, {300, 0.25f}}};
    EXPECT_THAT(zt_set_prefix_errors(decoder_, rows.data(), 3) == ZT_OK);
    EXPECT_THAT(zt_bytes_for_error(decoder_, 0.5f) == 200);
    zt_info info;
    zt_get_info(decoder_, &info, sizeof info);
    EXPECT_THAT((info.error < 0) == (info.bytes_consumed < 100));
  }

  std::span<const std::uint8_t> bytes_;
  FuzzPlan plan_;
  std::minstd_rand random_;
  CountingAllocator allocator_;
  zt_decoder* decoder_ = nullptr;
  std::unique_ptr<Request> request_;
  zt_status last_status_ = ZT_MORE_BYTES_WANTED;
  bool is_external_ = false, is_hostile_ = false, has_sane_step_ = true, is_finished_ = false;
};

}  // namespace
}  // namespace zerotree::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  zerotree::fuzz::FuzzRun({data, size}).run();
  return 0;
}
