// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugin/plugins.hpp"

#include <QStackedWidget>
#include <cstdint>
#include <functional>
#include <string>

namespace cortex::explorer {

class TextLabel;

// A view of a plug-in in its place. If it throws it is closed, and the reason stands there.
class OwnView : public QStackedWidget {
    Q_OBJECT
public:
    explicit OwnView(QWidget* parent = nullptr);

    void show(const ViewType& type, const std::string& path);
    void clear();
    void refresh(const Frame& frame);  // does nothing while it is hidden

Q_SIGNALS:
    void opened(const std::string& path);

private:
    void guarded(const std::function<void()>& call);
    void close(const QString& why);

    const ViewType* type_ = nullptr;
    std::string path_;
    View* view_ = nullptr;
    TextLabel *title_, *text_;
    std::uint64_t bound_ = 0;  // the structures of the frame that the view was bound to
};

}  // namespace cortex::explorer
