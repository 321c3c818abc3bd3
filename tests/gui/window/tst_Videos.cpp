// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcGauge.h"
#include "QPlcPanelContext.h"
#include "QPlcVideoExport.h"
#include "RecordedFlight.h"
#include "WindowFixtures.h"
#include "gui/layout/PageView.h"
#include "gui/layout/PanelTitleBar.h"
#include "gui/plant/PlantRecording.h"
#include "gui/window/VideoCommand.h"

#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>

Q_DECLARE_METATYPE(QPlcVideoExport::Options)

using namespace qplc;

namespace {

constexpr int cycles = 1000;  // of a flight, 10 ms each

/// Its colour is the number of the cycle that the window shows.
class ColourPanel : public QPlcWidget
{
public:
    static QString typeName() { return QStringLiteral("Colour"); }
    using QPlcWidget::QPlcWidget;
    QString kind() const override { return typeName(); }
    static int cycleOf(QRgb colour) { return int(colour & 0xffffffU); }

protected:
    void contextChanged() override
    {
        connect(context(), &QPlcPanelContext::changed, this, QOverload<>::of(&QWidget::update));
    }
    void paintEvent(QPaintEvent * /*event*/) override
    {
        const double cycle = context()->shown(QStringLiteral("position_x")).number();
        QPainter(this).fillRect(rect(), QColor::fromRgb(0xff000000U | QRgb(cycle)));
    }
};

struct FlightFile : RecordedFlight
{
    FlightFile()
    {
        if (!begin() || !start())
            qFatal("%s", qPrintable(error));
        for (int done = 0; done < cycles; done += 100) {
            step(100);
            recorder.proceed(&error);
        }
        cycle.stop();
        ring->endTexts();
        if (recorder.proceed(&error) != PlantRecorder::Ended || !recorder.finish(&error))
            qFatal("%s", qPrintable(error));
    }
};

/// A window with a recording: the signal position_x has the number of the cycle.
struct VideoWindow : WindowFixture
{
    VideoWindow()
    {
        QString error;
        window.addPanel<ColourPanel>();
        if (window.openRecording({flight.file}, &error).isEmpty())
            qFatal("%s", qPrintable(error));
        auto *view = part<LayoutView>();
        colour = view->widget(view->addPanel(ColourPanel::typeName()));
        gauge = view->widget(view->addPanel(QStringLiteral("Gauge")));
        gauge->applySettings({{QStringLiteral("signal"), QStringLiteral("position_x")},
                              {QStringLiteral("style"), QStringLiteral("number")}});
        plot = view->widget(view->addPanel(QStringLiteral("Time plot")));
        plot->addSignals({QStringLiteral("position_x")});
        QVERIFY(waitUntil([this] { return colour->isVisible() && gauge->isVisible(); }));
        options.from = 1.0;
        options.to = 3.0;
        options.framesPerSecond = 5.0;
    }
    /// \return whether a video was written
    bool make(const QString &name)
    {
        if (!video.start(name, options))
            return false;
        const bool hasEnded = waitUntil([this] { return !video.isRunning(); }, 3 * patience);
        return hasEnded && video.errorString().isEmpty();
    }
    /// \param a, b  [s] of the recording
    void setCursors(double a, double b)
    {
        QPlcTimeAxis *axis = window.context()->timeAxis();
        const QPlcTimeAxis::Time begin = plant()->recording()->begin();
        axis->setCursor(QPlcTimeAxis::A, begin + std::llround(a * 1e9));
        axis->setCursor(QPlcTimeAxis::B, begin + std::llround(b * 1e9));
    }
    /// What is seen in a picture.
    PageView *page() const
    {
        QWidget *parent = colour;
        while (parent && !qobject_cast<PageView *>(parent))
            parent = parent->parentWidget();
        return qobject_cast<PageView *>(parent);
    }
    /// Where the colour is in a picture.
    QPoint place() const { return colour->mapTo(page(), colour->rect().center()) * window.devicePixelRatioF(); }
    QString file(const char *name) const { return folder.filePath(QLatin1String(name)); }
    QStringList written() const
    {
        return QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot);
    }

    FlightFile flight;
    QTemporaryDir folder;
    QPlcWidget *colour = nullptr;
    QPlcWidget *gauge = nullptr;
    QPlcWidget *plot = nullptr;
    QPlcVideoExport::Options options;
    QPlcVideoExport video{&window};
};

/// A program `ffmpeg` of the test, and no other one.
class Encoder
{
public:
    explicit Encoder(const QByteArray &script)
    {
        if (!script.isEmpty()) {
            QFile file(m_folder.filePath(QStringLiteral("ffmpeg")));
            if (!file.open(QIODevice::WriteOnly) || file.write("#!/bin/sh\nPATH='" + m_path + "'\n" + script) < 0)
                qFatal("the program of the test cannot be written");
            file.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
        }
        qputenv("PATH", m_folder.path().toLocal8Bit());
    }
    ~Encoder() { qputenv("PATH", m_path); }
    Encoder(const Encoder &) = delete;
    Encoder &operator=(const Encoder &) = delete;

private:
    QByteArray m_path = qgetenv("PATH");
    QTemporaryDir m_folder;
};

/// Writes what it is given into the last argument.
const QByteArray copies = "for last; do :; done\ncat > \"$last\"\n";

}  // namespace

// Videos and pictures of a recording, as its panels show it.
class tst_Videos : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void picturesHaveNoButtons();
    void picturesHaveNoButtonsOverCurves();
    void eachPictureShowsItsTime();
    void theMouseAndTheFocusAreNotInPictures();
    void gaugesShowTheTimeOfEachPicture();
    void theSpeedAndTheRateDecideWhichTimesAreShown();
    void plotsOfASinglePictureShowTheWholeRecording();
    void aVideoIsMadeOfAllPictures();
    void theSizeOfThePicturesIsTheWantedOne();
    void withoutAnEncoderThePersonIsToldWhatToInstall();
    void anEncoderThatFailsLeavesNothing_data();
    void anEncoderThatFailsLeavesNothing();
    void aCancelledVideoLeavesNothing();
    void whatIsThereIsReplacedOnRequestOnly();
    void aDiskWithTooLittleRoomIsRefusedBefore();
    void theCommandSavesWhatIsBetweenTheCursors();
    void theCommandSaysWhyThereIsNoVideo();
    void optionsOutOfRangeAreRefused_data();
    void optionsOutOfRangeAreRefused();

private:
    TestSettings m_settings;
};

void tst_Videos::picturesHaveNoButtons()
{
    VideoWindow fixture;
    const auto buttons = [&fixture] {
        int seen = 0;
        const QList<PanelTitleBar *> bars = fixture.page()->findChildren<PanelTitleBar *>();
        for (PanelTitleBar *bar : bars) {
            const QList<QToolButton *> all = bar->findChildren<QToolButton *>();
            seen += int(std::count_if(all.begin(), all.end(), [](QToolButton *button) { return button->isVisible(); }));
        }
        return seen;
    };
    const int before = buttons();
    QVERIFY(before > 0);
    int inPictures = 0;
    connect(&fixture.video, &QPlcVideoExport::progressed, this, [&] { inPictures += buttons(); });
    QVERIFY2(fixture.make(fixture.file("frames")), qPrintable(fixture.video.errorString()));
    QCOMPARE(inPictures, 0);
    QCOMPARE(buttons(), before);
    {
        QPlcVideoExport forgotten(&fixture.window);
        QVERIFY(forgotten.start(fixture.file("others"), fixture.options));
    }
    QCOMPARE(buttons(), before);
}

void tst_Videos::eachPictureShowsItsTime()
{
    VideoWindow fixture;
    QVERIFY2(fixture.make(fixture.file("frames")), qPrintable(fixture.video.errorString()));
    const QDir frames(fixture.file("frames"));
    QCOMPARE(frames.entryList(QDir::Files).size(), 11);
    for (int i = 0; i < 11; ++i) {
        const QImage frame(frames.filePath(QStringLiteral("frame_%1.png").arg(i, 6, 10, QLatin1Char('0'))));
        QCOMPARE(ColourPanel::cycleOf(frame.pixel(fixture.place())), 100 + 20 * i);
    }
    QCOMPARE(fixture.written(), QStringList{QStringLiteral("frames")});
}

/// The plots do not follow the newest values: outside of a video, a button goes back to them.
void tst_Videos::picturesHaveNoButtonsOverCurves()
{
    VideoWindow fixture;
    fixture.options.span = 0.5;
    const auto buttons = [&fixture] {
        const QList<QToolButton *> all = fixture.plot->findChildren<QToolButton *>();
        return std::count_if(all.begin(), all.end(), [](QToolButton *button) { return button->isVisible(); });
    };
    fixture.window.context()->timeAxis()->freeze();
    QTRY_VERIFY(buttons() > 0);
    std::ptrdiff_t inPictures = 0;
    connect(&fixture.video, &QPlcVideoExport::progressed, this, [&] { inPictures += buttons(); });
    QVERIFY2(fixture.make(fixture.file("frames")), qPrintable(fixture.video.errorString()));
    QCOMPARE(inPictures, std::ptrdiff_t(0));
    QTRY_VERIFY(buttons() > 0);
}

/// A person waits with the mouse over a plot, and moves it now and then.
void tst_Videos::theMouseAndTheFocusAreNotInPictures()
{
    VideoWindow fixture;
    fixture.options.span = 0.5;  // the curves move below the mouse
    const auto moveMouse = [&fixture](int x) {
        const QPoint place(x, fixture.plot->height() / 2);
        QTest::mouseMove(fixture.window.windowHandle(), fixture.plot->mapTo(&fixture.window, place));
        QCoreApplication::processEvents();
    };
    const QPlcTimeAxis *axis = fixture.window.context()->timeAxis();
    fixture.window.context()->timeAxis()->freeze();
    moveMouse(fixture.plot->width() / 2);
    moveMouse(fixture.plot->width() / 2 + 10);
    QTRY_VERIFY(axis->pointer().has_value());
    fixture.gauge->setFocus();
    int wrong = 0;
    connect(&fixture.video, &QPlcVideoExport::progressed, this, [&](int done) {
        const bool isAtPlayhead = !axis->pointer() && axis->displayTime() == axis->playhead();
        const QWidget *focus = fixture.window.focusWidget();
        wrong += isAtPlayhead && !(focus && fixture.page()->isAncestorOf(focus)) ? 0 : 1;
        moveMouse(fixture.plot->width() / 2 + done);
    });
    QVERIFY2(fixture.make(fixture.file("frames")), qPrintable(fixture.video.errorString()));
    QCOMPARE(wrong, 0);
    QCOMPARE(fixture.window.focusWidget(), static_cast<QWidget *>(fixture.gauge));
    moveMouse(fixture.plot->width() / 2);
    moveMouse(fixture.plot->width() / 2 + 10);
    QTRY_VERIFY(axis->pointer().has_value());
}

void tst_Videos::gaugesShowTheTimeOfEachPicture()
{
    VideoWindow fixture;
    QStringList texts;
    connect(&fixture.video, &QPlcVideoExport::progressed, this, [&] { texts << fixture.gauge->accessibleName(); });
    QVERIFY(fixture.make(fixture.file("frames")));
    QCOMPARE(texts.size(), 11);
    for (int i = 0; i < texts.size(); ++i)
        QVERIFY2(texts.at(i).contains(QString::number(100 + 20 * i)), qPrintable(texts.at(i)));
}

void tst_Videos::theSpeedAndTheRateDecideWhichTimesAreShown()
{
    VideoWindow fixture;
    fixture.options.speed = 2.0;
    fixture.options.framesPerSecond = 1.0;
    fixture.options.to = -1.0;  // 9.99 s
    QList<int> shown;
    connect(&fixture.video, &QPlcVideoExport::progressed, this,
            [&] { shown << int(fixture.colour->context()->shown(QStringLiteral("position_x")).number()); });
    QVERIFY(fixture.make(fixture.file("frames")));
    QCOMPARE(shown, QList<int>({100, 300, 500, 700, 900}));
    QCOMPARE(fixture.video.frames(), 5);
}

void tst_Videos::plotsOfASinglePictureShowTheWholeRecording()
{
    VideoWindow fixture;
    const QPlcTimeAxis *axis = fixture.window.context()->timeAxis();
    QVERIFY(fixture.make(fixture.file("frames")));
    QCOMPARE(axis->span(), Q_INT64_C(2'000'000'000));
    fixture.options.from = fixture.options.to = 5.0;
    QVERIFY(fixture.make(fixture.file("one")));
    QCOMPARE(fixture.video.frames(), 1);
    QCOMPARE(axis->span(), Q_INT64_C(9'990'000'000));
    const QImage frame(fixture.file("one/frame_000000.png"));
    QCOMPARE(ColourPanel::cycleOf(frame.pixel(fixture.place())), 500);
}

void tst_Videos::aVideoIsMadeOfAllPictures()
{
    VideoWindow fixture;
    const Encoder encoder(copies);
    QVERIFY2(fixture.make(fixture.file("video.mp4")), qPrintable(fixture.video.errorString()));
    QCOMPARE(fixture.written(), QStringList{QStringLiteral("video.mp4")});
    QFile video(fixture.file("video.mp4"));
    QVERIFY(video.open(QIODevice::ReadOnly));
    QCOMPARE(video.size() % 11, 0);
    const QSize page = fixture.page()->size() * fixture.window.devicePixelRatioF();
    const int width = page.width() & ~1;
    QCOMPARE(video.size() / 11, qint64(width) * (page.height() & ~1) * 4);
    const QPoint place = fixture.place();
    for (int i = 0; i < 11; ++i) {
        QVERIFY(video.seek(i * video.size() / 11 + (qint64(place.y()) * width + place.x()) * 4));
        const QByteArray bytes = video.read(3);
        QCOMPARE(uchar(bytes.at(0)) + 256 * uchar(bytes.at(1)), 100 + 20 * i);
    }
}

void tst_Videos::theSizeOfThePicturesIsTheWantedOne()
{
    VideoWindow fixture;
    fixture.options.size = QSize(640, 360);
    fixture.options.to = 1.0;
    QVERIFY2(fixture.make(fixture.file("frames")), qPrintable(fixture.video.errorString()));
    QCOMPARE(QImage(fixture.file("frames/frame_000000.png")).size(), QSize(640, 360));
}

void tst_Videos::withoutAnEncoderThePersonIsToldWhatToInstall()
{
    VideoWindow fixture;
    const Encoder none{QByteArray()};
    QVERIFY(!fixture.make(fixture.file("video.mp4")));
    QVERIFY2(fixture.video.errorString().contains(QLatin1String("ffmpeg, which is not installed")),
             qPrintable(fixture.video.errorString()));
    QCOMPARE(fixture.written(), QStringList());
}

void tst_Videos::anEncoderThatFailsLeavesNothing_data()
{
    QTest::addColumn<QByteArray>("script");
    QTest::addColumn<QString>("said");
    QTest::newRow("at once") << QByteArray("echo 'no such encoder' >&2\nexit 3\n") << "no such encoder";
    QTest::newRow("at the end") << copies + "exit 4\n"
                                << "code 4";
    QTest::newRow("in the middle") << QByteArray("head -c 100000 >/dev/null\nexit 0\n") << "before the last picture";
    QTest::newRow("by a signal") << QByteArray("head -c 100000 >/dev/null\nkill -9 $$\n") << "code 9";
}

void tst_Videos::anEncoderThatFailsLeavesNothing()
{
    QFETCH(QByteArray, script);
    QFETCH(QString, said);
    VideoWindow fixture;
    const Encoder encoder(script);
    QVERIFY(!fixture.make(fixture.file("video.webm")));
    QVERIFY2(fixture.video.errorString().contains(said), qPrintable(fixture.video.errorString()));
    QCOMPARE(fixture.written(), QStringList());
}

void tst_Videos::aCancelledVideoLeavesNothing()
{
    VideoWindow fixture;
    const Encoder encoder(copies);
    for (const char *name : {"frames", "video.mp4"}) {
        bool isWritten = true;
        const auto ended = connect(&fixture.video, &QPlcVideoExport::finished, this,
                                   [&isWritten](bool isGood) { isWritten = isGood; });
        QVERIFY(fixture.video.start(fixture.file(name), fixture.options));
        QVERIFY(fixture.video.isRunning());
        QMetaObject::Connection first;
        first = connect(&fixture.video, &QPlcVideoExport::progressed, this, [&] { fixture.video.cancel(); });
        QVERIFY(waitUntil([&] { return !fixture.video.isRunning(); }));
        disconnect(first);
        disconnect(ended);
        QVERIFY(!isWritten);
        QVERIFY(fixture.video.errorString().contains(QLatin1String("cancelled")));
        QCOMPARE(fixture.written(), QStringList());
    }
}

void tst_Videos::whatIsThereIsReplacedOnRequestOnly()
{
    VideoWindow fixture;
    const Encoder encoder(copies);
    QVERIFY(QDir(fixture.folder.path()).mkdir(QStringLiteral("frames")));
    QFile there(fixture.file("video.mp4"));
    QVERIFY(there.open(QIODevice::WriteOnly) && there.write("mine") == 4);
    there.close();
    for (const char *name : {"frames", "video.mp4"}) {
        QVERIFY(!fixture.make(fixture.file(name)));
        QVERIFY(fixture.video.errorString().contains(QLatin1String("is there already")));
    }
    QCOMPARE(QFileInfo(there).size(), 4);
    fixture.options.isReplacing = true;
    QVERIFY(fixture.make(fixture.file("video.mp4")));
    QVERIFY(QFileInfo(fixture.file("video.mp4")).size() > 1000);
    QVERIFY(!fixture.make(fixture.file("frames")));
}

void tst_Videos::aDiskWithTooLittleRoomIsRefusedBefore()
{
    VideoWindow fixture;
    QVERIFY(!fixture.make(QStringLiteral("/proc/frames")));  // has none
    QVERIFY2(fixture.video.errorString().contains(QLatin1String("the disk has 0.0 GB free")),
             qPrintable(fixture.video.errorString()));
}

void tst_Videos::theCommandSavesWhatIsBetweenTheCursors()
{
    VideoWindow fixture;
    QVERIFY(fixture.action("Save a video of the recording...")->isEnabled());
    auto *command = fixture.part<VideoCommand>();
    fixture.setCursors(2.4, 2.0);
    command->save(fixture.file("frames"));
    QVERIFY(!fixture.action("Save a video of the recording...")->isEnabled());
    QVERIFY(waitUntil([&] { return !command->isRunning(); }));
    QCOMPARE(fixture.hint(), QStringLiteral("frames: 11 pictures"));
    QCOMPARE(ColourPanel::cycleOf(QImage(fixture.file("frames/frame_000000.png")).pixel(fixture.place())), 200);
    QCOMPARE(ColourPanel::cycleOf(QImage(fixture.file("frames/frame_000010.png")).pixel(fixture.place())), 240);
    QVERIFY(fixture.action("Save a video of the recording...")->isEnabled());
}

void tst_Videos::theCommandSaysWhyThereIsNoVideo()
{
    VideoWindow fixture;
    auto *command = fixture.part<VideoCommand>();
    const Encoder none{QByteArray()};
    command->save(fixture.file("video.mp4"));
    QVERIFY2(fixture.hint().contains(QLatin1String("ffmpeg")), qPrintable(fixture.hint()));
    fixture.window.disconnectFromMaster(fixture.window.plants().constFirst());
    QVERIFY(!fixture.action("Save a video of the recording...")->isEnabled());
}

void tst_Videos::optionsOutOfRangeAreRefused_data()
{
    QTest::addColumn<QPlcVideoExport::Options>("options");
    QTest::addColumn<QString>("said");
    QPlcVideoExport::Options slow;
    slow.framesPerSecond = 0.5;
    QTest::newRow("rate") << slow << "use 1 to 120";
    QPlcVideoExport::Options still;
    still.speed = 0.0;
    QTest::newRow("speed") << still << "use 0.001 to 100000";
    QPlcVideoExport::Options many;
    many.speed = 0.001;
    many.framesPerSecond = 100.0;
    QTest::newRow("number") << many << "at most 200000 are made";
    QPlcVideoExport::Options late;
    late.from = 10.0;
    QTest::newRow("times") << late << "it has 0 to 9.990 s";
    QPlcVideoExport::Options large;
    large.size = QSize(100'000, 10);
    QTest::newRow("size") << large << "at most 7680 pixels";
}

void tst_Videos::optionsOutOfRangeAreRefused()
{
    QFETCH(QPlcVideoExport::Options, options);
    QFETCH(QString, said);
    VideoWindow fixture;
    fixture.options = options;
    QVERIFY(!fixture.make(fixture.file("frames")));
    QVERIFY2(fixture.video.errorString().contains(said), qPrintable(fixture.video.errorString()));
    QVERIFY(!fixture.video.isRunning());
}

QTEST_MAIN(tst_Videos)
#include "tst_Videos.moc"
