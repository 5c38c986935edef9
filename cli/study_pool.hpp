#pragma once
#include "study/run/pool.hpp"
#include "study/run/session_record.hpp"

namespace flowslide::cli {

/// Stages as processes of this program, with all that this machine has.
study::PoolOptions usual_pool_options();

study::SessionRecord this_session(const study::PoolOptions& options);

/// The same events, and what they cost so far.
study::PoolEvents logged(study::PoolEvents events, study::SessionLog& log);

}  // namespace flowslide::cli
