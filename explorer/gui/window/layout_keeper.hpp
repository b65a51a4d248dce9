// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"
#include "window/layouts.hpp"

#include <QObject>
#include <QTimer>
#include <functional>

namespace cortex::gui {

// Keeps how the window is arranged: restores it before anything has come, and saves it a moment
// after each change, for the agents that are heard then.
class LayoutKeeper : public QObject {
    Q_OBJECT
public:
    struct Arranged {
        std::function<QJsonObject()> saved;
        std::function<void(const QJsonObject&)> restore;
    };
    LayoutKeeper(Layouts layouts, Arranged arranged, QObject* parent = nullptr);

    // Restores what was saved last for the domain; or what the file says, and then nothing is
    // saved by itself.
    void begin(int domain, const QString& file = {});
    void refresh(const Frame& frame);
    void noteChange();
    void noteSize();  // of the window; the window manager may have changed it
    // The command line says it: no layout changes it.
    void keepSize() { keepsSize_ = true; }
    void save();    // at once, if something has changed
    void reset();   // to how a window begins, in its size
    void goBack();  // to what was there before the last layout that was opened, or before a reset
    bool canGoBack() const { return before_.has_value(); }
    QStringList named() const { return layouts_.named(); }
    QString folder() const { return layouts_.folder(); }
    void saveAs(const QString& file);  // .json
    void open(const QString& file);

Q_SIGNALS:
    void told(const QString& text, bool trouble);

private:
    void restore(QJsonObject layout);
    void tellTroubles();

    Layouts layouts_;
    Arranged arranged_;
    QTimer timer_;
    QJsonObject first_, last_;  // as the window began; what was restored last
    std::optional<QJsonObject> before_;
    int domain_ = 0;
    QStringList agents_;
    bool begun_ = false;  // and saves by itself
    bool known_ = false, restoring_ = false, keepsSize_ = false;
    bool changed_ = false, worked_ = false;  // since the last save; by the user
};

}  // namespace cortex::gui
