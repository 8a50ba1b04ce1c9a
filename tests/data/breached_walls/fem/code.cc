#include "fem/code.h"
