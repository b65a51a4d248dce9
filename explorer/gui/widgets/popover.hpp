// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QFrame>

class QVBoxLayout;

namespace cortex::gui {

// A small window with a title that a click beside it, or Esc, closes. It deletes itself then.
class Popover : public QFrame {
    Q_OBJECT
public:
    explicit Popover(const QString& title, QWidget* parent = nullptr);

    QVBoxLayout& rows() { return *rows_; }

Q_SIGNALS:
    void closed();  // by whatever a person did

protected:
    void closeEvent(QCloseEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    QVBoxLayout* rows_;
};

}  // namespace cortex::gui
