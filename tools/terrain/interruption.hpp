/// Ctrl-C and SIGTERM as a question a long computation asks now and then.
#pragma once

namespace eyepoint::tools {

/// From now on SIGINT and SIGTERM no longer end the process but make was_interrupted() true; a second one
/// ends it.
void watch_for_interruption();

[[nodiscard]] bool was_interrupted();

}  // namespace eyepoint::tools
