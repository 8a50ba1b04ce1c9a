/// Which of its kernels OpenBLAS takes.
#pragma once

#include <string>

namespace fem {

/// OpenBLAS up to 0.3.24 does not know the later processors of Intel (Raptor Lake, Emerald Rapids) and takes
/// for them its oldest kernels, "Prescott", with vectors of two numbers: a factorisation takes twice as long
/// (https://github.com/OpenMathLib/OpenBLAS/issues/4267). It reads OPENBLAS_CORETYPE as it is loaded, so this
/// starts the program anew with the kernels for the vectors that the processor has, unless that variable says
/// which. To be called first in main.
void restart_with_wide_blas(char** argv);

/// OpenBLAS' name for the kernels in use; empty with another BLAS.
std::string blas_kernels();

}  // namespace fem
