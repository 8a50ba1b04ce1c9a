#include "pipelines/code.h"

#include "fem/operators/symmetric_matrix.h"
