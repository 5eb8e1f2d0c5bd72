// A job system as a game engine has one: threads that wait for tasks. The caller works too.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "zerotree/zerotree.h"

namespace zerotree::bench {

class WorkerPool {
 public:
  explicit WorkerPool(std::uint32_t threads) : thread_count_(threads) {
    for (std::uint32_t i = 1; i < threads; ++i) workers_.emplace_back([this] { work(); });
  }
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool() {
    {
      const std::lock_guard lock(mutex_);
      is_closing_ = true;
    }
    wake_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }

  zt_jobs jobs() {
    return {[](void* user, std::uint32_t count, zt_task task, void* context) {
              static_cast<WorkerPool*>(user)->run(count, task, context);
            },
            this, thread_count_};
  }

 private:
  void run(std::uint32_t count, zt_task task, void* context) {
    {
      const std::lock_guard lock(mutex_);
      task_ = task;
      context_ = context;
      count_ = count;
      next_ = 0;
      busy_ = static_cast<std::uint32_t>(workers_.size());
      ++round_;
    }
    wake_.notify_all();
    take_tasks();
    std::unique_lock lock(mutex_);
    finished_.wait(lock, [&] { return busy_ == 0; });
  }

  void take_tasks() {
    for (std::uint32_t i = next_++; i < count_; i = next_++) task_(context_, i);
  }

  void work() {
    std::uint64_t seen = 0;
    for (;;) {
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [&] { return is_closing_ || round_ != seen; });
        if (is_closing_) return;
        seen = round_;
      }
      take_tasks();
      const std::lock_guard lock(mutex_);
      if (--busy_ == 0) finished_.notify_one();
    }
  }

  std::uint32_t thread_count_;
  std::mutex mutex_;
  std::condition_variable wake_, finished_;
  bool is_closing_ = false;
  std::uint64_t round_ = 0;
  std::uint32_t busy_ = 0;
  zt_task task_ = nullptr;
  void* context_ = nullptr;
  std::uint32_t count_ = 0;
  std::atomic<std::uint32_t> next_ = 0;
  std::vector<std::thread> workers_;
};

}  // namespace zerotree::bench
