// SPDX-License-Identifier: Apache-2.0
// What becomes of a file that is written, and of one that cannot be.
#include "model/whole_file.hpp"

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <csignal>

#include <sys/resource.h>
#include <sys/stat.h>

#include <gtest/gtest.h>

namespace cortex::gui {
namespace {

// As on a disk that is full: what goes beyond so many octets of a file is refused.
class FullDisk {
public:
    explicit FullDisk(rlim_t octets) {
        signal_ = std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{octets, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, signal_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

private:
    rlimit before_{};
    void (*signal_)(int) = SIG_DFL;
};

class WholeFile : public testing::Test {
protected:
    QByteArray content() const {
        QFile read{file};
        return read.open(QIODevice::ReadOnly) ? read.readAll() : QByteArray{"none"};
    }
    const QTemporaryDir folder;
    const QString file = folder.filePath("a.csv");
};

TEST_F(WholeFile, IsWrittenAndReplacesTheOneBefore) {
    for (const int size : {0, 1, 100'000}) {
        const QByteArray bytes(size, 'x');
        EXPECT_EQ(writeWholeFile(file, bytes), "");
        EXPECT_EQ(content(), bytes) << size;
    }
}

TEST_F(WholeFile, OnAFullDiskTheOneBeforeStaysAndItIsSaid) {
    ASSERT_EQ(writeWholeFile(file, "before"), "");
    for (const int size :
         {9'000, 100'000}) {  // less and more than is gathered before it is written
        const FullDisk full{8'192};
        EXPECT_NE(writeWholeFile(file, QByteArray(size, 'x')), "") << size;
    }
    EXPECT_EQ(content(), "before");
    EXPECT_EQ(QDir{folder.path()}.entryList(QDir::Files).size(), 1) << "nothing is left behind";
}

TEST_F(WholeFile, APipeOrAFolderIsNotReplaced) {
    ASSERT_EQ(mkfifo(file.toLocal8Bit().constData(), 0600), 0);
    EXPECT_EQ(writeWholeFile(file, "x"), "it is no ordinary file");
    const QString link = folder.filePath("link.csv");
    ASSERT_TRUE(QFile::link(file, link));
    EXPECT_EQ(writeWholeFile(link, "x"), "it is no ordinary file");
    EXPECT_EQ(writeWholeFile(folder.path(), "x"), "it is no ordinary file");
    EXPECT_NE(writeWholeFile(folder.filePath("none/a.csv"), "x"), "");
}

}  // namespace
}  // namespace cortex::gui
