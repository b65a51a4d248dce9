// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/view.hpp"

#include <QWidget>

class QLabel;
class QPushButton;

namespace cortex::explorer {

class PathButton;
class Sentence;

// The link of a FieldbusDevice in one row: its state as a mark and a word, how old the last answer
// is, what went wrong so far, and Reconnect.
class LinkRow : public QWidget {
    Q_OBJECT
public:
    // `names`: with the path of the device, which opens it.
    LinkRow(std::string device, bool names, QWidget* parent = nullptr);

    void refresh(const SystemNow& now, const QString& whyNoReconnect);
    void say(const QString& outcome);  // of Reconnect
    const std::string& device() const { return device_; }
    QPushButton& button() const { return *reconnect_; }

Q_SIGNALS:
    void reconnectWanted();
    void opened(const QString& path);

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void dress();
    QString facts() const;  // below what came of Reconnect

    std::string device_;
    QWidget* mark_;
    QLabel* word_;
    PathButton* path_;
    Sentence* facts_;
    QString told_, known_;
    QPushButton* reconnect_;
};

}  // namespace cortex::explorer
