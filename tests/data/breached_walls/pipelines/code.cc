#include "pipelines/code.h"

#include "fem/matrices/symmetric_matrix.h"
