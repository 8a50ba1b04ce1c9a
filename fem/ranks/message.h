/// Values on their way from one MPI rank to another. Internal to fem.
#pragma once

#include <mpi.h>

#include <Eigen/Dense>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace fem {

/// Whether a struct lists its members for messages:
///   template <typename Self>
///   static auto members(Self& self) { return std::tie(self.a, self.b); }
template <typename T, typename = void>
struct ListsMembers : std::false_type {};
template <typename T>
struct ListsMembers<T, std::void_t<decltype(T::members(std::declval<T&>()))>> : std::true_type {};

/// A sequence of values: what is put in comes out in the same order. Numbers, plain structs, structs that
/// list their members, lists of them, and matrices. Both ranks run the same program on the same kind of
/// machine.
class Message {
public:
  template <typename T>
  Message& operator<<(const T& value) {
    if constexpr (ListsMembers<T>::value) {
      std::apply([&](const auto&... member) { (*this << ... << member); }, T::members(value));
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      put(&value, sizeof value);
    }
    return *this;
  }
  template <typename T, typename Allocator>
  Message& operator<<(const std::vector<T, Allocator>& values) {
    *this << values.size();
    if constexpr (std::is_trivially_copyable_v<T>)
      put(values.data(), values.size() * sizeof(T));
    else
      for (const auto& value : values) *this << value;
    return *this;
  }
  template <typename Scalar, int rows, int columns, int order>
  Message& operator<<(const Eigen::Matrix<Scalar, rows, columns, order>& matrix) {
    *this << matrix.rows() << matrix.cols();
    put(matrix.data(), std::size_t(matrix.size()) * sizeof(Scalar));
    return *this;
  }

  template <typename T>
  Message& operator>>(T& value) {
    if constexpr (ListsMembers<T>::value) {
      std::apply([&](auto&... member) { (*this >> ... >> member); }, T::members(value));
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      get(&value, sizeof value);
    }
    return *this;
  }
  template <typename T, typename Allocator>
  Message& operator>>(std::vector<T, Allocator>& values) {
    std::size_t n = 0;
    *this >> n;
    values.resize(n);
    if constexpr (std::is_trivially_copyable_v<T>)
      get(values.data(), n * sizeof(T));
    else
      for (auto& value : values) *this >> value;
    return *this;
  }
  template <typename Scalar, int rows, int columns, int order>
  Message& operator>>(Eigen::Matrix<Scalar, rows, columns, order>& matrix) {
    Eigen::Index n_rows = 0, n_columns = 0;
    *this >> n_rows >> n_columns;
    matrix.resize(n_rows, n_columns);
    get(matrix.data(), std::size_t(matrix.size()) * sizeof(Scalar));
    return *this;
  }

  void send(int to, MPI_Comm communicator) const;
  static Message receive(int from, MPI_Comm communicator);

private:
  void put(const void* from, std::size_t n_bytes);
  void get(void* to, std::size_t n_bytes);

  std::vector<char> bytes_;
  std::size_t read_ = 0;
};

}  // namespace fem
