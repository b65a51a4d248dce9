// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QAbstractButton>

namespace cortex::explorer {

// The path of a simplex, which opens when it is pressed. It gives way in its middle.
class PathButton : public QAbstractButton {
    Q_OBJECT
public:
    explicit PathButton(QWidget* parent = nullptr);

    void show(const QString& path);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

Q_SIGNALS:
    void opened(const QString& path);

protected:
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
};

}  // namespace cortex::explorer
