/// Values on their way from one MPI rank to another. Internal to fem.
#pragma once

#include <mpi.h>

#include <Eigen/Dense>
#include <cstring>
#include <type_traits>
#include <vector>

#include "fem/mesh/grid.h"

namespace fem {

/// A sequence of values: what is put in comes out in the same order. Numbers, plain structs, lists of them,
/// matrices and meshes. Both ranks run the same program on the same kind of machine.
class Message {
public:
  template <typename T>
  Message& operator<<(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(&value, sizeof value);
    return *this;
  }
  template <typename T, typename Allocator>
  Message& operator<<(const std::vector<T, Allocator>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    *this << values.size();
    put(values.data(), values.size() * sizeof(T));
    return *this;
  }
  template <int rows, int columns, int order>
  Message& operator<<(const Eigen::Matrix<double, rows, columns, order>& matrix) {
    *this << matrix.rows() << matrix.cols();
    put(matrix.data(), std::size_t(matrix.size()) * sizeof(double));
    return *this;
  }
  Message& operator<<(const Grid& grid);

  template <typename T>
  Message& operator>>(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    get(&value, sizeof value);
    return *this;
  }
  template <typename T, typename Allocator>
  Message& operator>>(std::vector<T, Allocator>& values) {
    std::size_t n = 0;
    *this >> n;
    values.resize(n);
    get(values.data(), n * sizeof(T));
    return *this;
  }
  template <int rows, int columns, int order>
  Message& operator>>(Eigen::Matrix<double, rows, columns, order>& matrix) {
    Eigen::Index n_rows = 0, n_columns = 0;
    *this >> n_rows >> n_columns;
    matrix.resize(n_rows, n_columns);
    get(matrix.data(), std::size_t(matrix.size()) * sizeof(double));
    return *this;
  }
  Message& operator>>(Grid& grid);

  void send(int to, MPI_Comm communicator) const;
  static Message receive(int from, MPI_Comm communicator);

private:
  void put(const void* from, std::size_t n_bytes);
  void get(void* to, std::size_t n_bytes);

  std::vector<char> bytes_;
  std::size_t read_ = 0;
};

}  // namespace fem
