#pragma once

#include "meshes/gmsh/upstairs.h"
