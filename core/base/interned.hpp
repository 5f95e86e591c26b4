#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"

namespace mapproof {

/// What a pool takes for the same value: `View`, in which a value is looked up, `hash` and `same`.
/// Values that are the same must read alike everywhere; 0 and -0, which print differently, are two.
template <typename T>
struct Interning;

template <>
struct Interning<std::string> {
  using View = std::string_view;
  static std::size_t hash(View value) { return std::hash<View>()(value); }
  static bool same(View a, View b) { return a == b; }
};

/// Keeps each value once, under a number that stays. Values are never removed: the process ends
/// with its command. Safe from any thread; at() takes no lock, since values never move.
template <typename T>
class InternPool {
 public:
  using View = typename Interning<T>::View;

  /// @param most  Of values, with T(), whose number is 0.
  explicit InternPool(std::uint32_t most = ~std::uint32_t{0}) : most_(most) { add(T()); }
  ~InternPool() {
    for (std::uint64_t id = 0; id < size_; ++id) std::destroy_at(&at(id));
    for (std::size_t chunk = 0; chunk < chunks_.size(); ++chunk)
      if (T* values = chunks_[chunk].load())
        std::allocator<T>().deallocate(values, kFirst << chunk);
  }
  InternPool(const InternPool&) = delete;
  InternPool& operator=(const InternPool&) = delete;

  /// The number of a value, a new one if it has none. Amortised O(1) comparisons.
  /// @throws InvalidInput if all numbers are taken.
  std::uint32_t id_of(View value) {
    const std::lock_guard lock(mutex_);
    if (4 * (size_ + 1) > 3 * slots_.size()) grow();
    std::size_t slot = Interning<T>::hash(value) & (slots_.size() - 1);
    for (; slots_[slot] != kFree; slot = (slot + 1) & (slots_.size() - 1))
      if (Interning<T>::same(at(slots_[slot] - 1), value))
        return static_cast<std::uint32_t>(slots_[slot] - 1);
    const std::uint32_t id = add(T(value));
    slots_[slot] = id + 1;
    return id;
  }

  /// @param id  From id_of(), or 0.
  const T& at(std::uint64_t id) const {
    const auto [chunk, offset] = location_of(id);
    return chunks_[chunk].load(std::memory_order_acquire)[offset];
  }

  std::uint64_t size() const {
    const std::lock_guard lock(mutex_);
    return size_;
  }

 private:
  static constexpr std::size_t kFirst = 64;  ///< Values in the first chunk; each has twice more.
  static constexpr std::size_t kChunks = 27;
  static constexpr std::uint32_t kFree = 0;

  static std::pair<std::size_t, std::size_t> location_of(std::uint64_t id) {
    const std::uint64_t from_first = id + kFirst;
    const auto chunk =
        static_cast<std::size_t>(std::bit_width(from_first) - std::bit_width(kFirst));
    return {chunk, static_cast<std::size_t>(from_first - (kFirst << chunk))};
  }

  std::uint32_t add(T value) {
    if (size_ >= most_)
      throw InvalidInput("more than " + std::to_string(most_) + " different names or levels");
    const auto [chunk, offset] = location_of(size_);
    T* values = chunks_[chunk].load(std::memory_order_relaxed);
    if (values == nullptr) values = std::allocator<T>().allocate(kFirst << chunk);
    chunks_[chunk].store(values, std::memory_order_release);
    std::construct_at(values + offset, std::move(value));
    return static_cast<std::uint32_t>(size_++);
  }

  void grow() {
    std::vector<std::uint32_t> slots(slots_.empty() ? kFirst : 2 * slots_.size(), kFree);
    for (std::uint64_t id = 0; id < size_; ++id) {
      std::size_t slot = Interning<T>::hash(at(id)) & (slots.size() - 1);
      while (slots[slot] != kFree) slot = (slot + 1) & (slots.size() - 1);
      slots[slot] = static_cast<std::uint32_t>(id + 1);
    }
    slots_ = std::move(slots);
  }

  const std::uint32_t most_;
  mutable std::mutex mutex_;
  std::uint64_t size_ = 0;
  std::array<std::atomic<T*>, kChunks> chunks_{};
  std::vector<std::uint32_t> slots_;  ///< Open addressing: number + 1, or kFree. 2^k of them.
};

/// A value of the one pool of its type: four bytes however large it is, to copy and to keep many
/// of. Read as the value itself, compared and ordered by it. T() takes no room and no lock.
///
/// @note 40 bytes per different text besides the heap of a long one, until the process ends.
/// @throws InvalidInput, from what takes a value, if there are 2^32 - 1 different ones.
template <typename T>
class Interned {
 public:
  using View = typename Interning<T>::View;
  static constexpr bool kIsText = std::same_as<T, std::string>;

  Interned() = default;
  /// Of what a T can be looked up by: a std::string, a text, a vector.
  template <typename From>
  requires(std::convertible_to<const From&, View> && !std::same_as<From, Interned>)
      Interned(const From& value)
      : id_(pool().id_of(View(value))) {}  // NOLINT: it is its value.
  Interned(T&& value)                      // NOLINT: likewise.
      requires(!kIsText)
      : id_(pool().id_of(value)) {}

  const T& get() const { return pool().at(id_); }
  operator const T&() const { return get(); }  // NOLINT: likewise.
  operator std::string_view() const            // NOLINT: likewise.
      requires kIsText {
    return get();
  }
  const T* operator->() const { return &get(); }

  /// Equal numbers are of equal values.
  std::uint32_t id() const { return id_; }

  bool empty() const { return id_ == 0 || get().empty(); }
  std::size_t size() const { return get().size(); }
  auto begin() const requires(!kIsText) { return get().begin(); }
  auto end() const requires(!kIsText) { return get().end(); }

  friend bool operator==(const Interned& a, const Interned& b) {
    return a.id_ == b.id_ || (!kIsText && a.get() == b.get());
  }
  template <typename Other>
  requires(std::convertible_to<const Other&, View> && !std::same_as<Other, Interned>) friend bool
  operator==(const Interned& a, const Other& b) {
    return View(a.get()) == View(b);
  }
  friend auto operator<=>(const Interned& a, const Interned& b) {
    using Order = decltype(a.get() <=> b.get());
    return a.id_ == b.id_ ? Order::equivalent : a.get() <=> b.get();
  }
  friend std::ostream& operator<<(std::ostream& out, const Interned& value) requires kIsText {
    return out << value.get();
  }

 private:
  static InternPool<T>& pool() {
    static auto* const kPool = new InternPool<T>();  // Threads may read it until the process ends.
    return *kPool;
  }

  std::uint32_t id_ = 0;
};

/// A text that many rows share.
using Name = Interned<std::string>;

}  // namespace mapproof

template <>
struct std::hash<mapproof::Name> {
  std::size_t operator()(const mapproof::Name& name) const noexcept {
    return std::hash<std::uint32_t>()(name.id());
  }
};
