/// The loads of the kinds of bodies that there are: a new one is entered here, in scene/kinds/table.cc and in
/// BodyOptions, at the same place.
#include "pipelines/loads/bodies/chamber.h"
#include "pipelines/loads/bodies/drum.h"
#include "pipelines/loads/bodies/stub_axle.h"
#include "pipelines/loads/bodies/table_body.h"
#include "pipelines/loads/bodies/train_shaft.h"
#include "pipelines/loads/bodies/vibratory_shaft.h"

namespace pipelines {

const LoadMaker& load_maker_of(const BodyScene& body) {
  static const std::vector<const LoadMaker*> makers{
      &vibratory_shaft_loads(), &chamber_loads(),     &drum_loads(),
      &stub_axle_loads(),       &train_shaft_loads(), &table_body_loads()};
  return *makers.at(body.options.index());
}

}  // namespace pipelines
