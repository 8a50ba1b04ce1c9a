/// The kinds of bodies that a scene may have: a new one is entered here, in loads/bodies/table.cc and in
/// BodyOptions, at the same place.
#include "pipelines/scene/kinds/kinds.h"

namespace pipelines {

const std::vector<const BodyReader*>& body_readers() {
  static const std::vector<const BodyReader*> readers{
      &vibratory_shaft_reader(), &chamber_reader(),     &drum_reader(),
      &stub_axle_reader(),       &train_shaft_reader(), &table_body_reader()};
  return readers;
}

const BodyReader& reader_of(const BodyScene& body) {
  return *body_readers().at(body.options.index());
}

}  // namespace pipelines
