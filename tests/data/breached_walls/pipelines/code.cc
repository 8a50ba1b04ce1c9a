#include "pipelines/code.h"

#include "fem/equations/matrices/symmetric_matrix.h"
