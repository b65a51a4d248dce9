// SPDX-License-Identifier: Apache-2.0
#include "types/enum_names.hpp"

#include "cortex/core/quality.hpp"
#include "cortex/core/report.hpp"

namespace cortex {

// Those that no XML has.
template <>
inline constexpr std::array spellings<Quality>{"good", "stale", "bad", "lost"};
template <>
inline constexpr std::array spellings<Severity>{"info", "warning", "error"};

const char* name(Kind kind) { return spelling(kind); }
const char* name(State state) { return spelling(state); }
const char* name(Role role) { return spelling(role); }
const char* name(Direction direction) { return spelling(direction); }
const char* name(OnLoss onLoss) { return spelling(onLoss); }
const char* name(OnLimit onLimit) { return spelling(onLimit); }
const char* name(AtRest atRest) { return spelling(atRest); }
const char* name(OnBusy onBusy) { return spelling(onBusy); }
const char* name(OnSenderLost onSenderLost) { return spelling(onSenderLost); }
const char* name(OnInputLost onInputLost) { return spelling(onInputLost); }
const char* name(OnLeaseLost onLeaseLost) { return spelling(onLeaseLost); }
const char* name(Quality quality) { return spelling(quality); }
const char* name(Severity severity) { return spelling(severity); }

std::optional<Kind> kindFromName(std::string_view text) { return fromSpelling<Kind>(text); }
std::optional<State> stateFromName(std::string_view text) { return fromSpelling<State>(text); }
std::optional<Role> roleFromName(std::string_view text) { return fromSpelling<Role>(text); }
std::optional<Quality> qualityFromName(std::string_view text) {
    return fromSpelling<Quality>(text);
}
std::optional<Severity> severityFromName(std::string_view text) {
    return fromSpelling<Severity>(text);
}

}  // namespace cortex
