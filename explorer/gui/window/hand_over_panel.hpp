// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QFrame>
#include <memory>
#include <string>

class QLineEdit;
class QListWidget;
class QPushButton;

namespace cortex::explorer {

// To whom control of what is held goes: the names that hold a lease somewhere, or any other name. A
// popover: a click beside it, or Esc, closes it.
class HandOverPanel : public QFrame {
    Q_OBJECT
public:
    explicit HandOverPanel(std::shared_ptr<const Frame> frame, QWidget* parent = nullptr);

    void refresh(std::shared_ptr<const Frame> frame);  // with those who hold something by now
    QLineEdit& nameField() { return *name_; }
    QPushButton& handOverButton() { return *handOver_; }
    QStringList offered() const;

Q_SIGNALS:
    void chosen(const std::string& name);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void decide();

    std::shared_ptr<const Frame> frame_;
    QListWidget* others_;
    QLineEdit* name_;
    QPushButton* handOver_;
};

}  // namespace cortex::explorer
