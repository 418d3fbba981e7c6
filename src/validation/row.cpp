#include "validation/row.h"

#include <cmath>

namespace weft {

double error_of(const ValidationRow& row) {
    const double difference = std::abs(row.measured - row.theory);
    return row.relative ? difference / std::abs(row.theory) : difference;
}

bool is_within(const ValidationRow& row) {
    return error_of(row) <= row.tolerance;
}

} // namespace weft
