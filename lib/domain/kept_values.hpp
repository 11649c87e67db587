/// \file
/// What is computed from a domain alone, kept with it. Internal.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <typeindex>
#include <typeinfo>

namespace powercell {

/// Values, one of a type, made on first use. Thread-safe: who asks for a value while it is made waits. They
/// live as long as their owner, or longer where they are held. A copy of the owner starts without values.
class KeptValues {
 public:
  KeptValues() = default;
  KeptValues(const KeptValues&) {}
  KeptValues& operator=(const KeptValues&) {
    values_.clear();
    return *this;
  }
  ~KeptValues() = default;

  /// \param make  returns a shared pointer to the value; may ask for other values, but not for this one
  /// \throw what `make` throws; the next call makes the value again
  template <class T, class Make>
  std::shared_ptr<const T> get(const Make& make) const {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const void>& value = values_[std::type_index(typeid(T))];
    if (!value) value = std::shared_ptr<const T>(make());
    return std::static_pointer_cast<const T>(value);
  }

 private:
  mutable std::recursive_mutex mutex_;
  mutable std::map<std::type_index, std::shared_ptr<const void>> values_;
};

}  // namespace powercell
