#include "meshes/imported/model_bytes.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <type_traits>

#include "meshes/values/refused.h"

namespace meshes {

namespace {

enum class Outcome : char { model = 'm', geometry_refused = 'g', too_many_cells = 'c', mesh_refused = 'r' };

class ByteWriter {
public:
  explicit ByteWriter(Outcome outcome) : bytes_(1, char(outcome)) {}

  template <typename T>
  ByteWriter& add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  ByteWriter& add(const std::string& text) {
    add(text.size());
    bytes_ += text;
    return *this;
  }
  template <typename T>
  ByteWriter& add(const std::vector<T>& values) {
    add(values.size());
    for (const auto& value : values) add(value);
    return *this;
  }
  ByteWriter& add(const Piece& piece) {
    return add(piece.name)
        .add(piece.groups)
        .add(piece.shape)
        .add(piece.tag)
        .add(piece.size)
        .add(piece.centre_m)
        .add(piece.second_moment)
        .add(piece.notch_radius_m)
        .add(piece.notch_course_m);
  }
  std::string take() { return std::move(bytes_); }

private:
  std::string bytes_;
};

class ByteReader {
public:
  explicit ByteReader(const std::string& bytes) : bytes_(bytes) {}

  template <typename T>
  void get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    require(sizeof value);
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
  }
  void get(std::string& text) {
    const std::size_t n = count();
    text = bytes_.substr(at_, n);
    at_ += n;
  }
  template <typename T>
  void get(std::vector<T>& values) {
    values.resize(count());
    for (auto& value : values) get(value);
  }
  void get(Piece& piece) {
    get(piece.name);
    get(piece.groups);
    get(piece.shape);
    get(piece.tag);
    get(piece.size);
    get(piece.centre_m);
    get(piece.second_moment);
    get(piece.notch_radius_m);
    get(piece.notch_course_m);
  }
  void require_end() const { require_that(at_ == bytes_.size()); }
  static void require_that(bool sound) {
    if (!sound) throw MeshRefused("the import's process has handed over a mesh that does not fit together");
  }

private:
  void require(std::size_t n) const { require_that(n <= bytes_.size() - at_); }
  /// Reads the count of a list whose items take at least a byte each.
  std::size_t count() {
    std::size_t n = 0;
    get(n);
    require(n);
    return n;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

void require_indices(const std::vector<int>& indices, std::size_t end) {
  ByteReader::require_that(
      std::all_of(indices.begin(), indices.end(), [&](int i) { return i >= 0 && std::size_t(i) < end; }));
}

std::string written(const ModelMesh& model) {
  const CellMesh& m = model.mesh;
  return ByteWriter(Outcome::model)
      .add(m.kind)
      .add(m.points)
      .add(m.cells)
      .add(m.volume_id)
      .add(m.faces)
      .add(m.face_id)
      .add(model.pieces)
      .add(model.volumes)
      .add(model.straight_edges)
      .add(model.smallest_size_m)
      .take();
}

ModelMesh read_model(ByteReader& in) {
  ModelMesh model;
  CellMesh& m = model.mesh;
  in.get(m.kind);
  in.get(m.points);
  in.get(m.cells);
  in.get(m.volume_id);
  in.get(m.faces);
  in.get(m.face_id);
  in.get(model.pieces);
  in.get(model.volumes);
  in.get(model.straight_edges);
  in.get(model.smallest_size_m);
  in.require_end();
  ByteReader::require_that(m.kind == CellKind::tetrahedra || m.kind == CellKind::hexahedra);
  ByteReader::require_that(m.cells.size() == m.n_cells() * m.nodes_per_cell() &&
                           m.faces.size() == m.n_faces() * m.nodes_per_face());
  require_indices(m.cells, m.points.size());
  require_indices(m.faces, m.points.size());
  require_indices(m.volume_id, model.volumes.size());
  require_indices(m.face_id, model.pieces.size());
  return model;
}

}  // namespace

std::string bytes_of(const std::function<ModelMesh()>& action) {
  const auto refused = [](Outcome outcome, const std::string& what) {
    return ByteWriter(outcome).add(what).take();
  };
  try {
    return written(action());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const TooManyCells& error) {
    return ByteWriter(Outcome::too_many_cells).add(error.control()).add(std::string(error.what())).take();
  } catch (const GeometryRefused& error) {
    return refused(Outcome::geometry_refused, error.what());
  } catch (const MeshRefused& error) {
    return refused(Outcome::mesh_refused, error.what());
  } catch (const std::string& message) {
    return refused(Outcome::geometry_refused, "cannot be read or meshed: gmsh says: " + message);
  } catch (const std::exception& error) {
    return refused(Outcome::geometry_refused,
                   std::string("cannot be read or meshed (") + error.what() + "); repair it");
  } catch (...) {  // OpenCASCADE throws what it likes
    return refused(Outcome::geometry_refused, "cannot be read or meshed; repair it");
  }
}

ModelMesh model_from(const std::string& bytes) {
  ByteReader in(bytes);
  Outcome outcome{};
  in.get(outcome);
  std::string control, what;
  switch (outcome) {
    case Outcome::model:
      return read_model(in);
    case Outcome::too_many_cells:
      in.get(control);
      in.get(what);
      throw TooManyCells(control, what);
    case Outcome::geometry_refused:
      in.get(what);
      throw GeometryRefused(what);
    case Outcome::mesh_refused:
      in.get(what);
      throw MeshRefused(what);
  }
  ByteReader::require_that(false);
  return {};
}

}  // namespace meshes
