// SPDX-License-Identifier: Apache-2.0
#include "../common/RuntimeFolder.h"
#include "transport/LocalNotice.h"

#include <QtCore/QDir>
#include <QtTest/QtTest>

#include <algorithm>
#include <csignal>
#include <sys/resource.h>

using qplc::LocalNotice;

class tst_LocalNotice : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_folder = std::make_unique<RuntimeFolder>(); }
    void cleanup() { m_folder.reset(); }
    void noticeIsReadUntilItIsWithdrawn();
    void aNewNoticeTakesThePlaceOfTheOldOne();
    void noticesOfEndedProgramsAreIgnoredAndRemoved();
    void oversizedNoticeIsRefused();
    void aFolderThatOthersMayWriteIsNotUsed();
    void missingFolderMeansNoNotices();
    void aNoticeThatCannotBeWrittenLeavesNothing();
    void numberOfNoticesIsLimited();

private:
    QString home() const { return m_folder->notices(); }
    static QVector<QByteArray> sorted()
    {
        QVector<QByteArray> notices = LocalNotice::all();
        std::sort(notices.begin(), notices.end());
        return notices;
    }
    std::unique_ptr<RuntimeFolder> m_folder;
};

void tst_LocalNotice::noticeIsReadUntilItIsWithdrawn()
{
    QVERIFY(LocalNotice::all().isEmpty());
    {
        LocalNotice a, b;
        QVERIFY(a.post("one"));
        QVERIFY(b.post(QByteArray("t\0o", 3)));
        QCOMPARE(sorted(), (QVector<QByteArray>{"one", QByteArray("t\0o", 3)}));
        a.withdraw();
        a.withdraw();
        QCOMPARE(sorted().size(), 1);
    }
    QVERIFY(LocalNotice::all().isEmpty());
    QVERIFY(QDir(home()).entryList(QDir::Files).isEmpty());
}

void tst_LocalNotice::aNewNoticeTakesThePlaceOfTheOldOne()
{
    LocalNotice notice;
    QVERIFY(notice.post("before"));
    QVERIFY(notice.post("after"));
    QCOMPARE(LocalNotice::all(), QVector<QByteArray>{"after"});
}

void tst_LocalNotice::noticesOfEndedProgramsAreIgnoredAndRemoved()
{
    LocalNotice first;
    QVERIFY(first.post("lives"));
    QFile dead(home() + QStringLiteral("/dead"));  // as a program leaves it that is killed: without a lock
    QVERIFY(dead.open(QIODevice::WriteOnly) && dead.write("dead") == 4);
    dead.close();
    QCOMPARE(LocalNotice::all(), QVector<QByteArray>{"lives"});
    QVERIFY(dead.exists());
    LocalNotice second;
    QVERIFY(second.post("lives, too"));
    QVERIFY(!dead.exists());
    QCOMPARE(LocalNotice::all().size(), 2);
}

void tst_LocalNotice::oversizedNoticeIsRefused()
{
    LocalNotice notice;
    QVERIFY(!notice.post(QByteArray(LocalNotice::MaximumSize + 1, 'x')));
    QVERIFY(LocalNotice::all().isEmpty());
    QVERIFY(notice.post(QByteArray(LocalNotice::MaximumSize, 'x')));
    QCOMPARE(LocalNotice::all(), QVector<QByteArray>{QByteArray(LocalNotice::MaximumSize, 'x')});
}

void tst_LocalNotice::aFolderThatOthersMayWriteIsNotUsed()
{
    QVERIFY(QDir().mkdir(home()));
    QFile::setPermissions(home(), QFile::Permissions(0x7777));
    LocalNotice notice;
    QVERIFY(!notice.post("x"));
    QVERIFY(LocalNotice::all().isEmpty());
    QVERIFY(QFile::remove(home()) || QDir(home()).removeRecursively());
    QVERIFY(QFile::link(m_folder->path(), home()));  // nor a link to elsewhere
    QVERIFY(!notice.post("x"));
}

void tst_LocalNotice::missingFolderMeansNoNotices()
{
    qputenv("XDG_RUNTIME_DIR", "/proc/nowhere");
    LocalNotice notice;
    QVERIFY(!notice.post("x"));
    QVERIFY(LocalNotice::all().isEmpty());
}

/// As on a full disk.
void tst_LocalNotice::aNoticeThatCannotBeWrittenLeavesNothing()
{
    rlimit usual{};
    QCOMPARE(::getrlimit(RLIMIT_FSIZE, &usual), 0);
    const rlimit none{0, usual.rlim_max};
    const auto usualEnd = std::signal(SIGXFSZ, SIG_IGN);
    QCOMPARE(::setrlimit(RLIMIT_FSIZE, &none), 0);
    LocalNotice notice;
    const bool isUp = notice.post("x");
    QCOMPARE(::setrlimit(RLIMIT_FSIZE, &usual), 0);
    std::signal(SIGXFSZ, usualEnd);
    QVERIFY(!isUp);
    QVERIFY(QDir(home()).entryList(QDir::Files).isEmpty());
}

void tst_LocalNotice::numberOfNoticesIsLimited()
{
    std::vector<std::unique_ptr<LocalNotice>> many;
    for (int i = 0; i < LocalNotice::MaximumCount + 5; ++i) {
        many.push_back(std::make_unique<LocalNotice>());
        QVERIFY(many.back()->post(QByteArray::number(i)));
    }
    QCOMPARE(LocalNotice::all().size(), int(LocalNotice::MaximumCount));
}

QTEST_GUILESS_MAIN(tst_LocalNotice)
#include "tst_LocalNotice.moc"
