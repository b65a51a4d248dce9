// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QObject>
#include <cstdint>
#include <functional>

class QAbstractItemView;
class QLineEdit;

namespace cortex::gui {

enum class FilterKey : std::uint8_t { Down, Enter, CtrlEnter };

// Down and Enter in the filter of a table go to its rows: to the one that is chosen, otherwise to
// where a press of Down in them goes; or they do what `leave` does. Up in the first row goes back.
void joinFilter(QLineEdit& field, QAbstractItemView& rows,
                std::function<void(FilterKey)> leave = {});

}  // namespace cortex::gui
