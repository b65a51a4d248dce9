// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QString>
#include <optional>

namespace cortex::gui {

// What a view says in the place of what it would show.
struct NothingText {
    QString title, text;
};

// That nobody is heard, or why the domain cannot be joined; none: somebody is heard.
std::optional<NothingText> nothingText(const Frame& frame);

}  // namespace cortex::gui
