// SPDX-License-Identifier: Apache-2.0
#include "cortex/explorer/theme.hpp"

#include "style/look.hpp"

namespace cortex::explorer {

using gui::Look;
using gui::Tokens;

QColor markColour(Tone tone) {
    const Tokens& c = Look::colours();
    switch (tone) {
        case Tone::Demand:
            return c.target;
        case Tone::Limit:
            return c.warnEdge;
        case Tone::Fault:
            return c.fault;
        case Tone::NotLive:
            return c.data;
        case Tone::Track:
            return c.band;
        case Tone::Quiet:
            break;
    }
    return c.ink2;
}

QColor textColour(Tone tone) {
    const Tokens& c = Look::colours();
    switch (tone) {
        case Tone::Demand:
            return c.targetText;
        case Tone::Limit:
            return c.warnText;
        case Tone::Fault:
            return c.faultText;
        case Tone::NotLive:
            return c.dataText;
        case Tone::Track:
        case Tone::Quiet:
            break;
    }
    return c.ink2;
}

int units(double count) { return Look::units(count); }

}  // namespace cortex::explorer
