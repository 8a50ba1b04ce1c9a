#include "pipelines/base/files/hdf5_file.h"

#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <numeric>
#include <type_traits>
#include <utility>

#include "fem/models/solid/model.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/open_directory.h"

namespace pipelines {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t>);

/// The innermost cause on HDF5's error stack; to be asked before the next call clears it.
std::string last_cause() {
  std::string cause;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
        if (error->desc) *static_cast<std::string*>(text) = error->desc;
        return 1;
      },
      &cause);
  if (cause.empty()) return "unknown cause";
  // What the system said is in there, among times and addresses over two lines.
  const std::string title = "error message = '";
  if (const auto begin = cause.find(title); begin != std::string::npos)
    return cause.substr(begin + title.size(), cause.find('\'', begin + title.size()) - begin - title.size());
  return cause.substr(0, cause.find('\n'));
}

[[noreturn]] void fail(const std::string& file, const std::string& object, const std::string& what) {
  const std::string cause = last_cause();
  throw FileError(shown(file) + ": " + (object.empty() ? "" : object + ": ") + what + " (HDF5: " + cause +
                  ")");
}

/// An HDF5 identifier and how to close it. Construction from a failed call throws. What was written through
/// it may reach the disk only when it is closed: then call close(), since a destructor cannot tell of a
/// failure.
class Handle {
public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& file, const std::string& object,
         const std::string& what)
      : id_(id), close_(close) {
    if (id < 0) fail(file, object, what);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

  void close(const std::string& file, const std::string& object) {
    if (close_(std::exchange(id_, -1)) < 0)
      fail(file, object, "cannot be written completely; check the free space");
  }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

Handle property_list(hid_t of_class, const std::string& file) {
  return {H5Pcreate(of_class), H5Pclose, file, "", "no property list"};
}

void keep_order(hid_t list, const std::string& file) {
  if (H5Pset_obj_track_times(list, false) < 0 ||
      H5Pset_link_creation_order(list, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED) < 0)
    fail(file, "", "cannot switch object times off");
}

/// The format of HDF5 1.10, which needs a third of the bytes around a small dataset. The attributes of an
/// object stay in its header however many they are.
void use_format(hid_t access, hid_t creation, const std::string& file) {
  if (H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110) < 0 ||
      H5Pset_attr_phase_change(creation, 100, 0) < 0)
    fail(file, "", "cannot choose the format");
}

/// Renamed files need no lock, and some network file systems have none.
void no_lock(hid_t list, const std::string& file) {
  if (H5Pset_file_locking(list, false, true) < 0) fail(file, "", "cannot switch file locking off");
}

/// A file that could not be closed, because the disk is full, crashes the library's own clean-up when the
/// program or MPI ends; it has nothing else to do then. Only the first call of the library can switch it off.
void print_nothing() {
  static const herr_t without_clean_up = H5dont_atexit();
  static_cast<void>(without_clean_up);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Handle text_type(const std::string& file) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, file, "", "no text type");
  if (H5Tset_size(type, H5T_VARIABLE) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0)
    fail(file, "", "no text type");
  return type;
}

void make_groups(hid_t root, const std::string& file, const std::string& path) {
  for (std::size_t end = path.find('/', 1); !path.empty(); end = path.find('/', end + 1)) {
    const std::string part = path.substr(0, end);
    const htri_t exists = part == "/" ? 1 : H5Lexists(root, part.c_str(), H5P_DEFAULT);
    if (exists < 0) fail(file, part, "is no group");
    if (!exists) {
      const Handle creation = property_list(H5P_GROUP_CREATE, file);
      keep_order(creation, file);
      Handle group(H5Gcreate2(root, part.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose, file, part,
                   "cannot make the group");
      group.close(file, part);
    }
    if (end == std::string::npos) return;
  }
}

void set_attribute(hid_t object, const std::string& file, const std::string& path, const std::string& name,
                   hid_t type, const void* value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, file, path, "no data space");
  Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, file,
                   path, "cannot make the attribute \"" + name + "\"");
  if (H5Awrite(attribute, type, value) < 0) fail(file, path, "cannot write the attribute \"" + name + "\"");
  attribute.close(file, path);
}

void set_text(hid_t object, const std::string& file, const std::string& path, const std::string& name,
              const std::string& value) {
  const char* text = value.c_str();
  set_attribute(object, file, path, name, text_type(file), &text);
}

/// Whole rows of about 1 MB, so that one place over all instants or all places at one instant unpack a piece
/// each.
std::vector<hsize_t> chunk_of(const std::vector<hsize_t>& extent, std::size_t entry_bytes) {
  std::vector<hsize_t> chunk = extent;
  const hsize_t row =
      std::accumulate(extent.begin() + 1, extent.end(), hsize_t{entry_bytes}, std::multiplies<>());
  chunk[0] = std::clamp<hsize_t>((hsize_t{1} << 20) / row, 1, extent[0]);
  return chunk;
}

std::size_t count_of(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

/// Whether all values have the same bits.
bool is_constant(const void* values, std::size_t n, std::size_t bytes_each) {
  const auto* bytes = static_cast<const char*>(values);
  return std::memcmp(bytes, bytes + bytes_each, (n - 1) * bytes_each) == 0;
}

/// Of compressed values that are all the same only the one is written, as what HDF5 fills the dataset with.
void write_dataset(hid_t root, const std::string& file, const std::string& path, hid_t memory_type,
                   hid_t file_type, const void* values, const std::vector<std::size_t>& shape,
                   const Hdf5Label& label, Hdf5Compression compression) {
  make_groups(root, file, path.substr(0, path.find('/') == std::string::npos ? 0 : path.rfind('/')));
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  const bool empty = std::count(extent.begin(), extent.end(), hsize_t{0}) > 0;
  const Handle space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose,
                     file, path, "no data space");
  const Handle creation = property_list(H5P_DATASET_CREATE, file);
  if (H5Pset_obj_track_times(creation, false) < 0) fail(file, path, "cannot switch object times off");
  const bool compressed = compression != Hdf5Compression::none && !empty;
  const bool constant =
      compressed && values != nullptr && is_constant(values, count_of(shape), H5Tget_size(memory_type));
  if (compressed) {
    const auto chunk = chunk_of(extent, H5Tget_size(file_type));
    if (H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()) < 0 ||
        H5Pset_shuffle(creation) < 0 || H5Pset_deflate(creation, 1) < 0 ||
        (constant && H5Pset_fill_value(creation, memory_type, values) < 0))
      fail(file, path, "cannot compress");
  }
  Handle dataset(H5Dcreate2(root, path.c_str(), file_type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                 H5Dclose, file, path, "cannot make the dataset");
  if (!empty && !constant && values != nullptr &&
      H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    fail(file, path, "cannot write the dataset");
  if (!label.unit.empty()) set_text(dataset, file, path, "unit", label.unit);
  if (!label.description.empty()) set_text(dataset, file, path, "description", label.description);
  dataset.close(file, path);  // packs and writes the last chunks
}

Handle open_dataset(hid_t root, const std::string& file, const std::string& path) {
  return {H5Dopen2(root, path.c_str(), H5P_DEFAULT), H5Dclose, file, path, "no such dataset"};
}

std::vector<std::size_t> shape_of(hid_t dataset, const std::string& file, const std::string& path) {
  const Handle space(H5Dget_space(dataset), H5Sclose, file, path, "no data space");
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  if (H5Sget_simple_extent_dims(space, extent.data(), nullptr) < 0) fail(file, path, "has no shape");
  return {extent.begin(), extent.end()};
}

void read_dataset(hid_t root, const std::string& file, const std::string& path, hid_t memory_type,
                  H5T_class_t expected, void* into) {
  const Handle dataset = open_dataset(root, file, path);
  const Handle type(H5Dget_type(dataset), H5Tclose, file, path, "has no type");
  if (H5Tget_class(type) != expected)
    throw FileError(shown(file) + ": " + path + ": holds another type of data than expected");
  if (count_of(shape_of(dataset, file, path)) > 0 &&
      H5Dread(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, into) < 0)
    fail(file, path, "cannot read the dataset");
}

/// Rows of a dataset, and as much room in memory.
struct Rows {
  Rows(hid_t dataset, const std::string& file, const std::string& path, std::size_t first, std::size_t n)
      : in_file(H5Dget_space(dataset), H5Sclose, file, path, "no data space"),
        in_memory(chosen(file, path, first, n)) {}

  Handle in_file, in_memory;

private:
  Handle chosen(const std::string& file, const std::string& path, std::size_t first, std::size_t n) const {
    std::vector<hsize_t> extent(std::size_t(std::max(1, H5Sget_simple_extent_ndims(in_file))));
    std::vector<hsize_t> start(extent.size(), 0);
    if (H5Sget_simple_extent_dims(in_file, extent.data(), nullptr) < 0) fail(file, path, "has no shape");
    start[0] = first;
    extent[0] = n;
    if (H5Sselect_hyperslab(in_file, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr) < 0)
      fail(file, path, "has no such rows");
    return {H5Screate_simple(int(extent.size()), extent.data(), nullptr), H5Sclose, file, path,
            "no data space"};
  }
};

Handle open_attribute(hid_t root, const std::string& file, const std::string& path, const std::string& name) {
  return {H5Aopen_by_name(root, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, file, path,
          "no attribute \"" + name + "\""};
}

}  // namespace

Hdf5Writer::Hdf5Writer(const std::filesystem::path& file) : file_(file.string()) {
  print_nothing();
  const Handle creation = property_list(H5P_FILE_CREATE, file_);
  const Handle access = property_list(H5P_FILE_ACCESS, file_);
  keep_order(creation, file_);
  use_format(access, creation, file_);
  no_lock(access, file_);
  id_ = H5Fcreate(file_.c_str(), H5F_ACC_TRUNC, creation, access);
  if (id_ < 0) fail(file_, "", "cannot be created");
}

Hdf5Writer::~Hdf5Writer() {
  if (id_ >= 0 && H5Fclose(id_) < 0) fem::Environment::leave_mpi();
}

void Hdf5Writer::write(const std::string& object, const double* values, const std::vector<std::size_t>& shape,
                       const Hdf5Label& label, Hdf5Compression compression) {
  write_dataset(id_, file_, object, H5T_NATIVE_DOUBLE,
                compression == Hdf5Compression::deflate_single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE, values,
                shape, label, compression);
}

void Hdf5Writer::write(const std::string& object, const std::int32_t* values,
                       const std::vector<std::size_t>& shape, const Hdf5Label& label,
                       Hdf5Compression compression) {
  write_dataset(id_, file_, object, H5T_NATIVE_INT32, H5T_STD_I32LE, values, shape, label, compression);
}

void Hdf5Writer::write(const std::string& object, const std::vector<double>& values, const Hdf5Label& label) {
  write(object, values.data(), {values.size()}, label);
}

void Hdf5Writer::write(const std::string& object, const std::vector<std::string>& values,
                       const Hdf5Label& label) {
  std::vector<const char*> texts;
  for (const auto& value : values) texts.push_back(value.c_str());
  const Handle type = text_type(file_);
  write_dataset(id_, file_, object, type, type, texts.data(), {texts.size()}, label, Hdf5Compression::none);
}

void Hdf5Writer::make(const std::string& object, const std::vector<std::size_t>& shape,
                      const Hdf5Label& label, Hdf5Compression compression) {
  write_dataset(id_, file_, object, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, nullptr, shape, label, compression);
}

void Hdf5Writer::write_rows(const std::string& object, const double* values, std::size_t first_row,
                            std::size_t n_rows) {
  Handle dataset = open_dataset(id_, file_, object);
  {
    const Rows rows(dataset, file_, object, first_row, n_rows);
    if (H5Dwrite(dataset, H5T_NATIVE_DOUBLE, rows.in_memory, rows.in_file, H5P_DEFAULT, values) < 0)
      fail(file_, object, "cannot write the dataset");
  }
  dataset.close(file_, object);
}

void Hdf5Writer::link(const std::string& object, const std::string& existing) {
  make_groups(id_, file_, object.substr(0, object.rfind('/')));
  if (H5Lcreate_hard(id_, existing.c_str(), id_, object.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
    fail(file_, object, "cannot be another name of " + existing);
}

void Hdf5Writer::make_group(const std::string& object) {
  make_groups(id_, file_, object);
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, const std::string& value) {
  Handle open(H5Oopen(id_, object.c_str(), H5P_DEFAULT), H5Oclose, file_, object, "no such object");
  set_text(open, file_, object, name, value);
  open.close(file_, object);
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, double value) {
  Handle open(H5Oopen(id_, object.c_str(), H5P_DEFAULT), H5Oclose, file_, object, "no such object");
  set_attribute(open, file_, object, name, H5T_IEEE_F64LE, &value);
  open.close(file_, object);
}

void Hdf5Writer::close() {
  const hid_t id = id_;
  id_ = -1;
  if (id < 0 || H5Fclose(id) >= 0) return;
  fem::Environment::leave_mpi();
  fail(file_, "", "cannot be written completely; check the free space");
}

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file) : file_(file.string()) {
  print_nothing();
  const Handle access = property_list(H5P_FILE_ACCESS, file_);
  no_lock(access, file_);
  id_ = H5Fopen(file_.c_str(), H5F_ACC_RDONLY, access);
  if (id_ < 0) fail(file_, "", "cannot be opened");
}

Hdf5Reader::~Hdf5Reader() {
  H5Fclose(id_);
}

bool Hdf5Reader::has(const std::string& object) const {
  for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
    if (object != "/" && H5Lexists(id_, object.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

std::vector<std::string> Hdf5Reader::names(const std::string& group) const {
  const Handle open(H5Gopen2(id_, group.c_str(), H5P_DEFAULT), H5Gclose, file_, group, "no such group");
  std::vector<std::string> result;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* names) -> herr_t {
    static_cast<std::vector<std::string>*>(names)->push_back(name);
    return 0;
  };
  if (H5Literate(open, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, add, &result) < 0)
    fail(file_, group, "cannot list the group");
  return result;
}

std::vector<std::size_t> Hdf5Reader::shape(const std::string& dataset) const {
  return shape_of(open_dataset(id_, file_, dataset), file_, dataset);
}

void Hdf5Reader::read(const std::string& dataset, double* into) const {
  read_dataset(id_, file_, dataset, H5T_NATIVE_DOUBLE, H5T_FLOAT, into);
}

void Hdf5Reader::read(const std::string& dataset, std::int32_t* into) const {
  read_dataset(id_, file_, dataset, H5T_NATIVE_INT32, H5T_INTEGER, into);
}

void Hdf5Reader::read_rows(const std::string& dataset, double* into, std::size_t first_row,
                           std::size_t n_rows) const {
  const Handle open = open_dataset(id_, file_, dataset);
  const Rows rows(open, file_, dataset, first_row, n_rows);
  if (H5Dread(open, H5T_NATIVE_DOUBLE, rows.in_memory, rows.in_file, H5P_DEFAULT, into) < 0)
    fail(file_, dataset, "cannot read the dataset");
}

std::vector<double> Hdf5Reader::numbers(const std::string& dataset) const {
  std::vector<double> values(count_of(shape(dataset)));
  read(dataset, values.data());
  return values;
}

std::vector<std::string> Hdf5Reader::texts(const std::string& dataset) const {
  std::vector<char*> values(count_of(shape(dataset)), nullptr);
  const Handle type = text_type(file_);
  read_dataset(id_, file_, dataset, type, H5T_STRING, values.data());
  std::vector<std::string> result;
  for (char* value : values) {
    result.emplace_back(value ? value : "");
    H5free_memory(value);
  }
  return result;
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
  const Handle attribute = open_attribute(id_, file_, object, name);
  char* value = nullptr;
  if (H5Aread(attribute, text_type(file_), &value) < 0)
    fail(file_, object, "attribute \"" + name + "\" is no text");
  std::string result = value ? value : "";
  H5free_memory(value);
  return result;
}

double Hdf5Reader::number_attribute(const std::string& object, const std::string& name) const {
  const Handle attribute = open_attribute(id_, file_, object, name);
  double value = 0;
  if (H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0)
    fail(file_, object, "attribute \"" + name + "\" is no number");
  return value;
}

}  // namespace pipelines
