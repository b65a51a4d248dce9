// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"
#include "widgets/popover.hpp"

#include <memory>
#include <string>

class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;

namespace cortex::gui {

// To whom control of what is held goes: the names that hold a lease somewhere, or any other name.
class HandOverPanel : public Popover {
    Q_OBJECT
public:
    explicit HandOverPanel(std::shared_ptr<const Frame> frame, QWidget* parent = nullptr);

    void refresh(std::shared_ptr<const Frame> frame);  // with those who hold something by now
    QLineEdit& nameField() { return *name_; }
    QPushButton& handOverButton() { return *handOver_; }
    QStringList offered() const;
    QString whyNobody() const;  // is offered, and what to do; empty: somebody is

Q_SIGNALS:
    void chosen(const std::string& name);

private:
    void decide();

    std::shared_ptr<const Frame> frame_;
    QLabel* nobody_;
    QListWidget* others_;
    QLineEdit* name_;
    QPushButton* handOver_;
    bool shown_ = false;  // who holds something
};

}  // namespace cortex::gui
