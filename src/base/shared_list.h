// A list that does not change, and whose copies share it.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace stilb {

template <typename T>
class SharedList {
  public:
    SharedList() : SharedList(std::vector<T>{}) {}
    SharedList(std::initializer_list<T> values) : SharedList(std::vector<T>(values)) {}
    SharedList(std::vector<T> values)  // implicit: a list of values becomes one that is shared
        : values_(std::make_shared<const std::vector<T>>(std::move(values))) {}

    std::size_t size() const { return values_->size(); }
    bool empty() const { return values_->empty(); }
    const T* data() const { return values_->data(); }
    const T* begin() const { return data(); }
    const T* end() const { return data() + size(); }
    const T& front() const { return values_->front(); }
    const T& back() const { return values_->back(); }
    const T& at(std::size_t index) const { return values_->at(index); }
    const T& operator[](std::size_t index) const { return (*values_)[index]; }
    bool operator==(const SharedList& other) const { return *values_ == *other.values_; }

  private:
    std::shared_ptr<const std::vector<T>> values_;
};

}  // namespace stilb
