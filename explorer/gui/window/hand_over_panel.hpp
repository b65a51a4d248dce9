// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"
#include "widgets/popover.hpp"

#include <memory>
#include <string>

class QLabel;
class QLineEdit;
class QListWidget;
class QListWidgetItem;
class QPushButton;
class QStackedWidget;

namespace cortex::gui {

// To whom control of what is held goes: the names that hold a lease somewhere, or any other name.
// Nothing moves while it is open: names that come are added below, and one that goes keeps its row.
class HandOverPanel : public Popover {
    Q_OBJECT
public:
    explicit HandOverPanel(const std::shared_ptr<const Frame>& frame, QWidget* parent = nullptr);

    void refresh(
        const std::shared_ptr<const Frame>& frame);  // with those who hold something by now
    QLineEdit& nameField() { return *name_; }
    QPushButton& handOverButton() { return *handOver_; }
    QStringList offered() const;  // also who held something only a while ago
    QString whyNobody() const;    // is offered, and what to do; empty: somebody is

Q_SIGNALS:
    void chosen(const std::string& name);

private:
    void decide();
    void use(const QListWidgetItem* chosen);

    QLabel* nobody_;
    QListWidget* others_;
    QStackedWidget* place_;  // of one of the two
    QLineEdit* name_;
    QPushButton* handOver_;
};

}  // namespace cortex::gui
