# Flags that every target of ours shares. -ffp-contract=off: the compiler never fuses a*b+c on its
# own, so the same source gives the same bits wherever it is inlined. Designated initialisers name
# what differs from the defaults; a warning for each member that they leave out would forbid them.
include(CheckCXXSourceRuns)
find_program(WEFT_CCACHE ccache)
if(WEFT_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${WEFT_CCACHE})
endif()

add_library(weft_compiler INTERFACE)
target_compile_options(weft_compiler INTERFACE -Wall -Wextra -Wconversion -Wno-missing-field-initializers -Werror -ffp-contract=off)
# g++ 12 sees overlaps and overruns inside std::string that are not there (GCC bugs 105651, 105329),
# depending on what it inlines: warnings that come and go with a header must not stop a build.
target_compile_options(weft_compiler INTERFACE -Wno-error=restrict -Wno-error=array-bounds
    -Wno-error=stringop-overflow -Wno-error=stringop-overread -Wno-error=maybe-uninitialized)
target_compile_definitions(weft_compiler INTERFACE EIGEN_MPL2_ONLY)

# AVX2 where the machine that builds has it: the 3x3 block products are a third faster.
set(CMAKE_REQUIRED_FLAGS -mavx2)
check_cxx_source_runs("#include <immintrin.h>
int main() { volatile __m256i a = _mm256_set1_epi32(1); a = _mm256_add_epi32(a, a); return 0; }"
    WEFT_HAS_AVX2)
unset(CMAKE_REQUIRED_FLAGS)
if(WEFT_HAS_AVX2)
    target_compile_options(weft_compiler INTERFACE -mavx2)
endif()

# Our asserts stay in release (they cost under 1 % and catch our faults); Eigen's, one an access, go.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DEIGEN_NO_DEBUG")
set(CMAKE_CXX_FLAGS_PROFILE "${CMAKE_CXX_FLAGS_RELEASE} -g -fno-omit-frame-pointer")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g1 -DWEFT_DEBUG_BUILD -D_GLIBCXX_ASSERTIONS")
if(WEFT_SANITIZE)
    # These four double the time of compiling and of running, and find nothing that is not found
    # without them: an access through null, misaligned (Eigen asserts it) or outside its object ends
    # in a report of the address sanitizer, and an object of the wrong type is freed memory there.
    target_compile_options(weft_compiler INTERFACE
        -fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr
        -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
    target_link_options(weft_compiler INTERFACE -fsanitize=address,undefined)
endif()
