#pragma once
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace tvg::server {

/// Who may come in: so many connections at a time, and so many of them from one address. All of it may be
/// called from any thread.
class Admission {
 public:
  Admission(std::size_t most, std::size_t most_per_address)
      : most_(most), most_per_address_(most_per_address) {}

  /// Holds a place for as long as it lives.
  class Place {
   public:
    Place(Admission& admission, std::string address) : admission_(admission), address_(std::move(address)) {}
    ~Place() { admission_.leave(address_); }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

   private:
    Admission& admission_;
    std::string address_;
  };

  /// A place for a connection from `address`, which must not outlive this; null where there is none.
  std::shared_ptr<Place> enter(const std::string& address);
  /// Whether most places are taken, so that those who do nothing should make room.
  bool crowded() const;

 private:
  void leave(const std::string& address);

  const std::size_t most_;
  const std::size_t most_per_address_;
  mutable std::mutex mutex_;
  std::size_t inside_ = 0;
  std::map<std::string, std::size_t> by_address_;
};

}  // namespace tvg::server
