// SPDX-License-Identifier: Apache-2.0
#include "session/past.hpp"

#include <utility>

namespace cortex::gui {

void Past::ask(const std::string& agent, std::int64_t from, std::int64_t until, QObject* asker,
               Done done) {
    asked_.emplace(session_.askPast(agent, from, until), Asked{asker, std::move(done)});
}

void Past::deliver() {
    for (PastAnswer& each : session_.takePast()) {
        auto found = asked_.extract(each.number);
        if (!found.empty() && found.mapped().asker) found.mapped().done(std::move(each.past));
    }
}

}  // namespace cortex::gui
