// SPDX-License-Identifier: Apache-2.0
#include "session/typed_arguments.hpp"

#include "session/item_meaning.hpp"

#include <algorithm>

namespace cortex::gui {

void TypedArguments::keep(const Key& key, const DataItem& parameter, const QString& text) {
    std::erase_if(all_, [&](const Typed& each) { return each.key == key; });
    if (!text.isEmpty()) all_.push_back({key, parameter, text});
    if (all_.size() > most) all_.pop_front();
}

QString TypedArguments::of(const Key& key, const DataItem& parameter) const {
    const auto found = std::ranges::find(all_, key, &Typed::key);
    return found != all_.end() && meansTheSame(found->parameter, parameter) ? found->text
                                                                            : QString{};
}

void TypedArguments::noteSent(const std::string& path, const std::string& command) {
    for (Typed& each : all_)
        if (each.key.path == path && each.key.command == command) each.sent = true;
}

int TypedArguments::unsent() const {
    return static_cast<int>(std::ranges::count(all_, false, &Typed::sent));
}

}  // namespace cortex::gui
