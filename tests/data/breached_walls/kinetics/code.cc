#include "kinetics/code.h"
#include "fem/code.h"
