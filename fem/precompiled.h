/// Private precompiled header of fem: what most of its .cc files include. The code builds without it too.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <functional>
#include <string>
#include <vector>
