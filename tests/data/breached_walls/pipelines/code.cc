#include "pipelines/code.h"
