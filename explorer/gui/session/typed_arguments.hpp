// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <QString>
#include <list>
#include <string>

namespace cortex::gui {

// What was typed into the forms of commands, for as long as the window is there: it stands in the
// form again when its simplex comes back. Of very many the oldest are forgotten.
class TypedArguments {
public:
    struct Key {
        std::string path, command, parameter;
        bool operator==(const Key&) const = default;
    };
    static constexpr std::size_t most = 500;

    // Empty: what was typed was taken away.
    void keep(const Key& key, const DataItem& parameter, const QString& text);
    // Empty also where the parameter means something else by now.
    QString of(const Key& key, const DataItem& parameter) const;
    void noteSent(const std::string& path, const std::string& command);
    int unsent() const;  // those that were typed since

private:
    struct Typed {
        Key key;
        DataItem parameter;  // as it was then
        QString text;
        bool sent = false;
    };
    std::list<Typed> all_;  // newest last
};

}  // namespace cortex::gui
