#pragma once

#include "fit/em.h"
#include "stability.h"

namespace lobelight::stability {

// Puts the mixture, the number of iterations and the course of the log-likelihood into the record.
void describe(Record& record, const EmResult& result);

}  // namespace lobelight::stability
