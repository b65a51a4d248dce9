// SPDX-License-Identifier: Apache-2.0
#include "enum_names.hpp"

namespace cortex {

const char* name(Kind kind) { return spelling(kind); }
const char* name(State state) { return spelling(state); }
const char* name(Role role) { return spelling(role); }
const char* name(Direction direction) { return spelling(direction); }
const char* name(OnLoss onLoss) { return spelling(onLoss); }
const char* name(OnLimit onLimit) { return spelling(onLimit); }
const char* name(OnBusy onBusy) { return spelling(onBusy); }
const char* name(OnSenderLost onSenderLost) { return spelling(onSenderLost); }
const char* name(OnLeaseLost onLeaseLost) { return spelling(onLeaseLost); }

std::optional<Kind> kindFromName(std::string_view text) { return fromSpelling<Kind>(text); }
std::optional<State> stateFromName(std::string_view text) { return fromSpelling<State>(text); }

}  // namespace cortex
