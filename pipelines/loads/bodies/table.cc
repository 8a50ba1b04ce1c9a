/// The kinds of bodies that there are: a new one is entered here and in BodyOptions, at the same place.
#include "pipelines/loads/bodies/chamber.h"
#include "pipelines/loads/bodies/drum.h"
#include "pipelines/loads/bodies/stub_axle.h"
#include "pipelines/loads/bodies/table_body.h"
#include "pipelines/loads/bodies/train_shaft.h"
#include "pipelines/loads/bodies/vibratory_shaft.h"
#include "pipelines/scene/whole/body_kind.h"

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
