// SPDX-License-Identifier: Apache-2.0
#include "widgets/enter_key.hpp"

#include <QAbstractButton>
#include <QComboBox>
#include <QKeyEvent>

namespace cortex::gui {

bool pressFocused(const QKeyEvent& event, const QWidget& window) {
    const bool enter = event.key() == Qt::Key_Return || event.key() == Qt::Key_Enter;
    if (!enter || (event.modifiers() & ~Qt::KeypadModifier) != 0) return false;
    auto* button = qobject_cast<QAbstractButton*>(window.focusWidget());
    auto* list = qobject_cast<QComboBox*>(window.focusWidget());
    if (button == nullptr && list == nullptr) return false;
    if (event.isAutoRepeat()) return true;
    if (list != nullptr) list->showPopup();
    if (button != nullptr) button->click();
    return true;
}

}  // namespace cortex::gui
