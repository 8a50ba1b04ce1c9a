/// The kinds of bodies that there are: a new one is entered here and in BodyOptions, at the same place.
#include "pipelines/bodies/chamber.h"
#include "pipelines/bodies/drum.h"
#include "pipelines/bodies/stub_axle.h"
#include "pipelines/bodies/table_body.h"
#include "pipelines/bodies/train_shaft.h"
#include "pipelines/bodies/vibratory_shaft.h"
#include "pipelines/scene/body_kind.h"

namespace pipelines {

const std::vector<const BodyKind*>& body_kinds() {
  static const std::vector<const BodyKind*> kinds{
      &vibratory_shaft_kind(), &chamber_kind(),     &drum_kind(),
      &stub_axle_kind(),       &train_shaft_kind(), &table_body_kind()};
  return kinds;
}

const BodyKind& kind_of(const BodyScene& body) {
  return *body_kinds().at(body.options.index());
}

}  // namespace pipelines
