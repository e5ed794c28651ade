#include "server/admission.hpp"

namespace tvg::server {

std::shared_ptr<Admission::Place> Admission::enter(const std::string& address) {
  const std::lock_guard lock(mutex_);
  const auto known = by_address_.find(address);
  if (inside_ >= most_ || (known != by_address_.end() && known->second >= most_per_address_)) return nullptr;
  std::size_t& from_there = by_address_[address];
  auto place = std::make_shared<Place>(*this, address);  // may throw: counted after it
  ++from_there;
  ++inside_;
  return place;
}

bool Admission::crowded() const {
  const std::lock_guard lock(mutex_);
  return 4 * inside_ > 3 * most_;
}

void Admission::leave(const std::string& address) {
  const std::lock_guard lock(mutex_);
  const auto found = by_address_.find(address);
  if (--found->second == 0) by_address_.erase(found);
  --inside_;
}

}  // namespace tvg::server
