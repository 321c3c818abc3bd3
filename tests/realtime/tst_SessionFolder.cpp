// SPDX-License-Identifier: Apache-2.0
#include "realtime/SessionFolder.h"

#include <QtTest/QtTest>

#include <cerrno>
#include <memory>
#include <unistd.h>

using namespace qplc;

class tst_SessionFolder : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void cleanup();
    void folderIsInTheSessionOfTheUser();
    void folderIsInTmpWithTheUserIdWithoutASession();
    void folderIsPrivateToTheUser();
    void foldersWritableByOthersAreRefused();
    void linksAndFilesAreRefused();
    void foldersThatCannotBeMadeAreRefused();

private:
    QByteArray folder() const { return QFile::encodeName(m_folder->filePath(QStringLiteral("x"))); }

    const QByteArray m_before = qgetenv("XDG_RUNTIME_DIR");
    std::unique_ptr<QTemporaryDir> m_folder;
};

void tst_SessionFolder::init()
{
    m_folder = std::make_unique<QTemporaryDir>();
}

void tst_SessionFolder::cleanup()
{
    if (m_before.isNull())
        qunsetenv("XDG_RUNTIME_DIR");
    else
        qputenv("XDG_RUNTIME_DIR", m_before);
}

void tst_SessionFolder::folderIsInTheSessionOfTheUser()
{
    qputenv("XDG_RUNTIME_DIR", "/run/user/7");
    QCOMPARE(SessionFolder::path("x"), QByteArray("/run/user/7/x"));
}

void tst_SessionFolder::folderIsInTmpWithTheUserIdWithoutASession()
{
    const QByteArray expected = "/tmp/x-" + QByteArray::number(quint64(::getuid()));
    qunsetenv("XDG_RUNTIME_DIR");
    QCOMPARE(SessionFolder::path("x"), expected);
    qputenv("XDG_RUNTIME_DIR", "not/absolute");
    QCOMPARE(SessionFolder::path("x"), expected);
}

void tst_SessionFolder::folderIsPrivateToTheUser()
{
    QVERIFY(SessionFolder::make(folder()));
    const QFile::Permissions others = QFile::ReadGroup | QFile::WriteGroup | QFile::ReadOther | QFile::WriteOther;
    QVERIFY(QFileInfo(folder()).isDir());
    QCOMPARE(QFile::permissions(folder()) & others, QFile::Permissions());
    QVERIFY(SessionFolder::make(folder()));  // it is there
}

void tst_SessionFolder::foldersWritableByOthersAreRefused()
{
    QVERIFY(SessionFolder::make(folder()));
    for (const auto who : {QFile::WriteGroup, QFile::WriteOther}) {
        QVERIFY(QFile::setPermissions(folder(), QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner | who));
        QVERIFY(!SessionFolder::make(folder()));
        QCOMPARE(errno, EPERM);
    }
}

void tst_SessionFolder::linksAndFilesAreRefused()
{
    QVERIFY(QFile::link(m_folder->path(), folder()));
    QVERIFY(!SessionFolder::make(folder()));
    QCOMPARE(errno, EPERM);
    QVERIFY(QFile::remove(folder()));
    QFile file(folder());
    QVERIFY(file.open(QIODevice::WriteOnly));
    QVERIFY(!SessionFolder::make(folder()));
}

void tst_SessionFolder::foldersThatCannotBeMadeAreRefused()
{
    QVERIFY(!SessionFolder::make(folder() + "/y"));
    QCOMPARE(errno, ENOENT);
}

QTEST_GUILESS_MAIN(tst_SessionFolder)
#include "tst_SessionFolder.moc"
