// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QTreeWidget>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace cortex::gui {

// How the types of an agent agree with those of each other agent, item by item.
class AgreementTable : public QTreeWidget {
    Q_OBJECT
public:
    explicit AgreementTable(QWidget* parent = nullptr);
    // Compares with one other agent a call, as each may take some milliseconds.
    void show(const Frame& frame, const AgentFrame& agent);
    // How many rows there are for; none: not all are compared yet.
    std::optional<int> count() const;
    static constexpr int most = 1'000;  // rows that are shown
    std::size_t compared() const { return compared_; }

private:
    void compare(const AgentFrame& agent, const AgentFrame& other);

    std::string agent_;
    std::uint64_t structures_ = 0;
    std::size_t next_ = 0, compared_ = 0;
    int found_ = 0;
    bool done_ = false;
};

}  // namespace cortex::gui
