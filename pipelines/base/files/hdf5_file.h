/// HDF5 files, as much of them as results need: datasets of numbers and of text, groups, attributes of text
/// and numbers. Objects are named by their path in the file ("/quantities/theta"); groups on the way are made
/// as needed. Files hold no times and list their objects in the order of writing, so the same calls give the
/// same bytes. Datasets are contiguous unless compressed, row-major (last index fastest), little endian
/// 64-bit floats or 32-bit integers; text is UTF-8 of variable length. Every failure is a std::runtime_error
/// that names file and object; HDF5 itself prints nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pipelines {

/// Attributes every dataset of a result carries; empty ones are left out.
struct Hdf5Label {
  std::string unit;
  std::string description;
};

enum class Hdf5Compression {
  none,
  deflate,        ///< bytes shuffled first, one chunk of about 1 MB per piece; of equal values one is kept
  deflate_single  ///< doubles as floats of 32 bits, and then as deflate
};

class Hdf5Writer {
public:
  /// Creates the file; one that exists is overwritten (write to AtomicFile::temporary()).
  explicit Hdf5Writer(const std::filesystem::path& file);
  ~Hdf5Writer();  ///< closes; write errors at this point are lost: call close()
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// @param values  as many as the product of `shape`; read in place, not copied
  void write(const std::string& object, const double* values, const std::vector<std::size_t>& shape,
             const Hdf5Label& label = {}, Hdf5Compression compression = Hdf5Compression::none);
  void write(const std::string& object, const std::int32_t* values, const std::vector<std::size_t>& shape,
             const Hdf5Label& label = {}, Hdf5Compression compression = Hdf5Compression::none);
  void write(const std::string& object, const std::vector<double>& values, const Hdf5Label& label = {});
  void write(const std::string& object, const std::vector<std::string>& values, const Hdf5Label& label = {});
  /// A dataset of doubles whose rows, of its first index, are written by write_rows.
  void make(const std::string& object, const std::vector<std::size_t>& shape, const Hdf5Label& label = {},
            Hdf5Compression compression = Hdf5Compression::none);
  /// @param values  values of n_rows rows
  void write_rows(const std::string& object, const double* values, std::size_t first_row, std::size_t n_rows);
  /// Gives a dataset another name, under which it is read as it is.
  void link(const std::string& object, const std::string& existing);
  void make_group(const std::string& object);
  /// @param object  an existing group ("/" for the file as a whole) or dataset
  void attribute(const std::string& object, const std::string& name, const std::string& value);
  void attribute(const std::string& object, const std::string& name, double value);

  /// Flushes and closes. @throws FileError if something could not be written
  void close();

private:
  std::string file_;
  std::int64_t id_ = -1;
};

class Hdf5Reader {
public:
  explicit Hdf5Reader(const std::filesystem::path& file);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  bool has(const std::string& object) const;
  /// Names of what a group holds, in the order of writing.
  std::vector<std::string> names(const std::string& group) const;
  std::vector<std::size_t> shape(const std::string& dataset) const;

  /// @param into  room for the product of shape(dataset)
  void read(const std::string& dataset, double* into) const;
  void read(const std::string& dataset, std::int32_t* into) const;
  /// Some rows, of the first index.
  void read_rows(const std::string& dataset, double* into, std::size_t first_row, std::size_t n_rows) const;
  std::vector<double> numbers(const std::string& dataset) const;
  std::vector<std::string> texts(const std::string& dataset) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  double number_attribute(const std::string& object, const std::string& name) const;

private:
  std::string file_;
  std::int64_t id_ = -1;
};

}  // namespace pipelines
