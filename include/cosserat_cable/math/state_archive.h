// The numbers of a state, into a list and back: one function names them all, so that what is read
// is what was written.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/math/small.h"

namespace cosserat_cable {

/// Lists keep their lengths: a state is read into what has the same number of everything.
class StateArchive {
 public:
  /// Writes.
  StateArchive() = default;
  /// Reads these.
  explicit StateArchive(std::vector<double> numbers)
      : numbers_(std::move(numbers)), reading_(true) {}

  bool reading() const { return reading_; }
  /// All that was written.
  const std::vector<double>& numbers() const { return numbers_; }
  /// @throws std::invalid_argument where not all was read
  void Finish() const {
    if (reading_ && next_ != numbers_.size()) Refuse();
  }

  /// Appends the numbers, or takes the next ones.
  /// @throws std::invalid_argument where there are no more
  template <class First, class Second, class... More>
  void Exchange(First* first, Second* second, More*... more) {
    Exchange(first);
    Exchange(second, more...);
  }
  void Exchange(double* x) {
    if (!reading_) {
      numbers_.push_back(*x);
      return;
    }
    if (next_ == numbers_.size()) Refuse();
    *x = numbers_[next_++];
  }
  void Exchange(bool* x) { ExchangeAs(x); }
  void Exchange(char* x) { ExchangeAs(x); }
  template <int kRows, int kColumns, int kOptions>
  void Exchange(Eigen::Matrix<double, kRows, kColumns, kOptions>* x) {
    static_assert(kRows > 0 && kColumns > 0, "of a fixed size");
    for (Eigen::Index i = 0; i < x->size(); ++i) Exchange(x->data() + i);
  }
  template <int kRows>
  void Exchange(Eigen::Array<double, kRows, 1>* x) {
    for (Eigen::Index i = 0; i < x->size(); ++i) Exchange(x->data() + i);
  }
  void Exchange(Eigen::Quaterniond* q) { Exchange(&q->coeffs()); }
  void Exchange(Vec3<double>* v) { Exchange(&v->x, &v->y, &v->z); }
  void Exchange(Quat<double>* q) { Exchange(&q->w, &q->x, &q->y, &q->z); }
  void Exchange(Pose* X) { Exchange(&X->p, &X->q); }
  void Exchange(Motion* m) { Exchange(&m->X, &m->v, &m->omega, &m->a, &m->alpha); }
  template <class T>
  void Exchange(std::vector<T>* list) {
    for (T& x : *list) Exchange(&x);
  }
  /// Of a list whose items `exchange(item)` goes through.
  template <class T, class Function>
  void ExchangeEach(std::vector<T>* list, const Function& exchange) {
    for (T& x : *list) exchange(&x);
  }

 private:
  template <class T>
  void ExchangeAs(T* x) {
    double number = *x;
    Exchange(&number);
    *x = static_cast<T>(number);
  }
  [[noreturn]] static void Refuse() {
    throw std::invalid_argument("the state is one of another model");
  }

  std::vector<double> numbers_;
  std::size_t next_ = 0;
  bool reading_ = false;
};

}  // namespace cosserat_cable
