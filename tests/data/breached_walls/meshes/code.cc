#include "meshes/code.h"
