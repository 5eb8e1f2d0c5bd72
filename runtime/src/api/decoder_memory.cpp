#include "api/decoder_memory.h"

#include <cstdint>
#include <new>

namespace zerotree::api {

namespace {

// What zt_allocator promises.
constexpr std::size_t kAlignment = 16;

/// Bytes to ask for so that an aligned block and the offset to it fit.
std::size_t with_room(std::size_t size, std::size_t alignment) {
  return alignment <= kAlignment ? size : size + alignment;
}

}  // namespace

void* DecoderMemory::take(const zt_allocator& allocator, std::size_t size) {
  if (allocator.allocate) return allocator.allocate(allocator.user, size);
  return ::operator new(size, std::nothrow);
}

void DecoderMemory::give_back(const zt_allocator& allocator, void* memory, std::size_t size) {
  if (allocator.allocate)
    allocator.release(allocator.user, memory, size);
  else
    ::operator delete(memory);
}

void* DecoderMemory::do_allocate(std::size_t size, std::size_t alignment) {
  const std::size_t asked = with_room(size, alignment);
  if (asked < size) throw std::bad_alloc();
  auto* memory = static_cast<unsigned char*>(take(allocator_, asked));
  if (!memory) throw std::bad_alloc();
  held_ += asked;
  if (alignment <= kAlignment) return memory;
  // The byte before the block says how many sixteenths it lies behind what was given.
  const std::size_t over = reinterpret_cast<std::uintptr_t>(memory) % alignment;
  const std::size_t shift = alignment - over;
  memory[shift - 1] = static_cast<unsigned char>(shift / kAlignment);
  return memory + shift;
}

void DecoderMemory::do_deallocate(void* block, std::size_t size, std::size_t alignment) {
  auto* memory = static_cast<unsigned char*>(block);
  if (alignment > kAlignment) memory -= memory[-1] * kAlignment;
  const std::size_t asked = with_room(size, alignment);
  held_ -= asked;
  give_back(allocator_, memory, asked);
}

}  // namespace zerotree::api
