#pragma once
#include <cstdint>
#include <optional>

// Numbers a reader may not know: keys, sections and channels (format-spec §3.5).
namespace tvg {

/// Whether a reader that does not know the number must not go on as if it were not there.
constexpr bool is_required(std::uint64_t number) {
  return number % 2 == 1;
}

/// A list of numbers as it is read.
class AscendingNumbers {
 public:
  /// False where the number is not above the one before.
  bool take(std::uint64_t number) {
    const bool ascends = !last_ || number > *last_;
    last_ = number;
    return ascends;
  }

 private:
  std::optional<std::uint64_t> last_;
};

}  // namespace tvg
