#include "kinetics/drive_train.h"

namespace kinetics {

DriveTrain::DriveTrain() = default;
DriveTrain::DriveTrain(const DriveTrain&) = default;
DriveTrain::DriveTrain(DriveTrain&&) noexcept = default;
DriveTrain& DriveTrain::operator=(const DriveTrain&) = default;
DriveTrain& DriveTrain::operator=(DriveTrain&&) noexcept = default;
DriveTrain::~DriveTrain() = default;

}  // namespace kinetics
