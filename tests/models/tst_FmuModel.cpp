// SPDX-License-Identifier: Apache-2.0
// The life of an FMU, and archives that are none.
#include "ThreadCosts.h"
#include "models/FmuModel.h"

#include <QtTest/QtTest>

#include <cstring>

using qplc::FmuExchange;
using qplc::FmuModel;
using qplc::FmuVariable;
using namespace std::chrono_literals;

class tst_FmuModel : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void inputsMoveTheModel_data() { addVersions(); }
    void inputsMoveTheModel();
    void timeIsAMultipleOfTheStep_data();
    void timeIsAMultipleOfTheStep();
    void everySimulationBeginsAnew_data() { addVersions(); }
    void everySimulationBeginsAnew();
    void eventsAreHandledAfterTheStep_data();
    void eventsAreHandledAfterTheStep();
    void discreteInputsChangeAtEvents();
    void startValuesReachTheModel_data() { addVersions(); }
    void startValuesReachTheModel();
    void wrongStartValuesAreNamed_data();
    void wrongStartValuesAreNamed();
    void endedAndDiscardedStepsAreTheEnd_data();
    void endedAndDiscardedStepsAreTheEnd();
    void errorsAreThrownWithWhatTheModelReports_data() { addVersions(); }
    void errorsAreThrownWithWhatTheModelReports();
    void afterAFatalErrorNothingIsCalled_data() { addVersions(); }
    void afterAFatalErrorNothingIsCalled();
    void aFloodOfLinesIsCountedAndDelaysNothing();
    void stepsAllocateNothing_data() { addVersions(); }
    void stepsAllocateNothing();
    void unusableFilesAreRefusedWithAReason_data();
    void unusableFilesAreRefusedWithAReason();
    void unusableLibrariesAreRefusedWithAReason_data();
    void unusableLibrariesAreRefusedWithAReason();
    void foldersAreRemovedAtTheEndAndAfterACrash();

private:
    static void addVersions()
    {
        QTest::addColumn<QString>("file");
        QTest::newRow("FMI 2") << "plant2";
        QTest::newRow("FMI 3") << "plant3";
    }

    QTemporaryDir m_temporary;
};

namespace {

QString pathOf(const QString &name)
{
    return QStringLiteral(QTPLC_TEST_FMUS "/%1.fmu").arg(name);
}

/// The plant with its usual input and outputs.
struct Plant
{
    explicit Plant(const QString &name, const QStringList &starts = {})
    {
        model = FmuModel::open(pathOf(name), &error);
        if (!model || !model->load(&error))
            return;
        FmuModel::Settings settings;
        for (const QString &text : starts) {
            FmuModel::Start start;
            if (FmuModel::readStart(model->description(), text.section('=', 0, 0), text.section('=', 1), &start,
                                    &error))
                settings.starts.append(start);
        }
        model->setSettings(settings);
        model->setStep(0.1);
        u = model->inputs().add(variable("u"));
        x = model->outputs().add(variable("x"));
        mode = model->outputs().add(variable("mode"));
    }

    const FmuVariable &variable(const QString &name) const { return *model->description().find(name); }
    void set(double value) { std::memcpy(model->inputs().at(u), &value, sizeof(value)); }
    double position()
    {
        double value = 0.0;
        std::memcpy(&value, model->outputs().at(x), sizeof(value));
        return value;
    }
    int modeNumber()
    {
        int value = 0;  // of 32 or 64 bits, little-endian
        std::memcpy(&value, model->outputs().at(mode), sizeof(value));
        return value;
    }
    void begin()
    {
        model->reset();
        model->readOutputs();
        model->initialize();
    }
    void step(int count = 1)
    {
        for (int i = 0; i < count; ++i) {
            model->writeInputs();
            model->doStep();
            if (!model->isOver())
                model->readOutputs();
        }
    }

    QString error;
    std::unique_ptr<FmuModel> model;
    FmuExchange::Place u, x, mode;
};

template<typename Function>
QString thrownBy(Function function)
{
    try {
        function();
    } catch (const std::exception &failure) {
        return QString::fromUtf8(failure.what());
    }
    return {};
}

QStringList folders()
{
    return QDir(QDir::tempPath()).entryList({"qtplc-fmu-*"}, QDir::Dirs);
}

}  // namespace

/// Other tests have folders, too.
void tst_FmuModel::initTestCase()
{
    QVERIFY(m_temporary.isValid());
    qputenv("TMPDIR", QFile::encodeName(m_temporary.path()));
}

void tst_FmuModel::inputsMoveTheModel()
{
    QFETCH(QString, file);
    Plant plant(file, {"x0=5"});
    QVERIFY2(plant.error.isEmpty(), qPrintable(plant.error));
    plant.model->reset();
    plant.model->readOutputs();
    QCOMPARE(plant.position(), 5.0);  // in the initialization, too
    plant.model->initialize();
    plant.set(2.0);
    plant.step(3);
    QCOMPARE(plant.position(), 5.6);
    QCOMPARE(plant.model->time(), 0.3);
}

void tst_FmuModel::timeIsAMultipleOfTheStep_data()
{
    QTest::addColumn<double>("step");
    QTest::addColumn<int>("count");
    QTest::addColumn<double>("end");
    QTest::newRow("1/60 s") << 1.0 / 60 << 60'000 << 1000.0;
    QTest::newRow("1/3 s") << 1.0 / 3 << 300 << 100.0;
    QTest::newRow("0.1 s") << 0.1 << 12'345 << 1234.5;
    QTest::newRow("7 ns") << 7e-9 << 10'000 << 7e-5;
}

void tst_FmuModel::timeIsAMultipleOfTheStep()
{
    QFETCH(double, step);
    QFETCH(int, count);
    QFETCH(double, end);
    Plant plant("plant2");
    plant.model->reset();
    plant.model->setStep(step);
    plant.model->initialize();
    for (int k = 0; k < count; ++k) {
        QVERIFY2(std::abs(plant.model->time() - k * step) <= 5e-16 * k * step, qPrintable(QString::number(k)));
        plant.model->doStep();
    }
    QCOMPARE(plant.model->time(), end);
}

void tst_FmuModel::everySimulationBeginsAnew()
{
    QFETCH(QString, file);
    Plant plant(file);
    QVERIFY2(plant.error.isEmpty(), qPrintable(plant.error));
    for (int i = 0; i < 3; ++i) {
        plant.begin();
        plant.set(1.0);
        plant.step(10);
        QCOMPARE(plant.position(), 0.1 + 0.1 + 0.1 + 0.1 + 0.1 + 0.1 + 0.1 + 0.1 + 0.1 + 0.1);
        if (i != 1)
            plant.model->end();
    }
}

void tst_FmuModel::eventsAreHandledAfterTheStep_data()
{
    addVersions();
    QTest::newRow("declares event mode and refuses it") << "without_events";
}

void tst_FmuModel::eventsAreHandledAfterTheStep()
{
    QFETCH(QString, file);
    Plant plant(file, {"limit=0.25"});
    QVERIFY2(plant.error.isEmpty(), qPrintable(plant.error));
    plant.begin();
    plant.set(1.0);
    plant.step(2);
    QCOMPARE(plant.modeNumber(), 0);
    plant.step();
    QCOMPARE(plant.modeNumber(), 1);
}

/// The plant refuses them in step mode, and counts as changed what differs from the last time.
void tst_FmuModel::discreteInputsChangeAtEvents()
{
    Plant plant("plant3");
    QVERIFY2(plant.error.isEmpty(), qPrintable(plant.error));
    const FmuExchange::Place enabled = plant.model->inputs().add(plant.variable("enabled"));
    *plant.model->inputs().at(enabled) = 1;
    plant.begin();
    plant.set(1.0);
    plant.step();
    QCOMPARE(plant.position(), 0.1);
    *plant.model->inputs().at(enabled) = 0;
    plant.step(2);
    QCOMPARE(plant.position(), 0.1);
    *plant.model->inputs().at(enabled) = 1;
    plant.step();
    QCOMPARE(plant.position(), 0.2);
}

void tst_FmuModel::startValuesReachTheModel()
{
    QFETCH(QString, file);
    Plant plant(file, {"x0=-1.5", "gain=2", "enabled=false", "label=a text", "u=3"});
    QVERIFY2(plant.error.isEmpty(), qPrintable(plant.error));
    plant.begin();
    plant.set(1.0);
    plant.step();
    QCOMPARE(plant.position(), -1.5);  // not enabled
}

void tst_FmuModel::wrongStartValuesAreNamed_data()
{
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("value");
    QTest::addColumn<QString>("text");
    QTest::newRow("unknown") << "gian"
                             << "1"
                             << "the FMU has no variable 'gian'; did you mean 'gain'?";
    QTest::newRow("output") << "x"
                            << "1"
                            << "'x' (output) has no start value that can be set";
    QTest::newRow("word") << "gain"
                          << "much"
                          << "'much' is not a value of 'gain' (Float64)";
    QTest::newRow("too large") << "fault"
                               << "3000000000"
                               << "'3000000000' is not a value of 'fault' (Int32)";
    QTest::newRow("truth") << "enabled"
                           << "perhaps"
                           << "'perhaps' is not a value of 'enabled' (Boolean)";
    QTest::newRow("too many") << "gain"
                              << "1, 2"
                              << "'gain' has 1 elements, and here are 2 values";
}

void tst_FmuModel::wrongStartValuesAreNamed()
{
    QFETCH(QString, name);
    QFETCH(QString, value);
    QFETCH(QString, text);
    const Plant plant("plant3", {name + '=' + value});
    QVERIFY2(plant.error.contains(text), qPrintable(plant.error));
}

void tst_FmuModel::endedAndDiscardedStepsAreTheEnd_data()
{
    QTest::addColumn<QString>("file");
    QTest::addColumn<int>("fault");
    QTest::addColumn<QString>("text");
    for (const char *file : {"plant2", "plant3"}) {
        QTest::addRow("%s discards", file) << file << 1 << "the FMU has discarded the step at 0.2 s";
        QTest::addRow("%s ends", file) << file << 2 << "the FMU has ended the simulation at 0.2 s";
    }
}

void tst_FmuModel::endedAndDiscardedStepsAreTheEnd()
{
    QFETCH(QString, file);
    QFETCH(int, fault);
    QFETCH(QString, text);
    Plant plant(file, {QStringLiteral("fault=%1").arg(fault), "faultTime=0.3"});
    QVERIFY2(plant.error.isEmpty(), qPrintable(plant.error));
    plant.begin();
    plant.set(1.0);
    plant.step(2);
    QVERIFY(!plant.model->isOver());
    plant.step(5);
    QVERIFY(plant.model->isOver());
    QCOMPARE(plant.model->overText(), text);
    QCOMPARE(plant.position(), 0.2);
    plant.begin();
    QVERIFY(!plant.model->isOver());
}

void tst_FmuModel::errorsAreThrownWithWhatTheModelReports()
{
    QFETCH(QString, file);
    Plant plant(file, {"fault=3", "faultTime=0.3"});
    QVERIFY2(plant.error.isEmpty(), qPrintable(plant.error));
    plant.begin();
    plant.step(2);
    const QString thrown = thrownBy([&] { plant.step(); });
    QVERIFY2(thrown.contains("reports an error (fmi")
                 && thrown.contains("DoStep) at 0.2 s, in a step: 'the tank is empty'"),
             qPrintable(thrown));
    plant.begin();  // which an error permits
    plant.step(2);
}

void tst_FmuModel::afterAFatalErrorNothingIsCalled()
{
    QFETCH(QString, file);
    Plant plant(file, {"fault=4", "faultTime=0.1"});
    QVERIFY2(plant.error.isEmpty(), qPrintable(plant.error));
    plant.begin();
    QVERIFY(thrownBy([&] { plant.step(); }).contains("a fatal error"));
    QVERIFY(thrownBy([&] { plant.begin(); }).contains("start this program again"));
}

void tst_FmuModel::aFloodOfLinesIsCountedAndDelaysNothing()
{
    Plant plant("plant2", {"fault=9", "faultTime=0.1"});
    QVERIFY2(plant.error.isEmpty(), qPrintable(plant.error));
    plant.begin();
    plant.step(3);
    qplc::FmuLog::Line line;
    quint64 lines = 0;
    while (plant.model->log().take(&line))
        ++lines;
    QCOMPARE(lines, quint64(qplc::FmuLog::Capacity));
    QCOMPARE(plant.model->log().takeLost() + lines, quint64(3000));
    QCOMPARE(qplc::FmuLog::textOf(line), QString("warning: flood (plant)"));
}

void tst_FmuModel::stepsAllocateNothing()
{
    QFETCH(QString, file);
    if (!ThreadCosts::areCounted())
        QSKIP("the sanitizer owns malloc", "");
    Plant plant(file, {"limit=5"});
    QVERIFY2(plant.error.isEmpty(), qPrintable(plant.error));
    plant.begin();
    plant.set(1.0);
    plant.step(10);
    const ThreadCosts before = ThreadCosts::ofThisThread();
    plant.step(1000);
    const ThreadCosts spent = ThreadCosts::ofThisThread() - before;
    QCOMPARE(plant.modeNumber(), 1);
    QCOMPARE(spent.allocations, std::uint64_t(0));
    QCOMPARE(spent.locks, std::uint64_t(0));
}

void tst_FmuModel::unusableFilesAreRefusedWithAReason_data()
{
    QTest::addColumn<QString>("text");
    const auto row = [](const char *file, const char *text) { QTest::newRow(file) << QString(text); };
    row("absent", "there is no such file");
    row("text", "is not a complete zip archive");
    row("half", "is not a complete zip archive");
    row("nothing", "is not a complete zip archive");
    row("empty", "has no modelDescription.xml; it is not an FMU");
    row("without_description", "has no modelDescription.xml; it is not an FMU");
    row("parent", "entry '../evil' leaves its folder");
    row("parent_inside", "leaves its folder");
    row("absolute", "entry '/tmp/evil' has an absolute path");
    row("drive", "has an absolute path");
    row("backslash", "leaves its folder");
    row("link", "entry 'resources/link' is a link");
    row("link_folder", "entry 'resources' is a link");
    row("control", "has control characters");
    row("deep", "is more than 32 folders deep");
    row("long_name", "more than 1024 bytes");
    row("many", "entries, more than 20000");
    row("file_and_folder", "resources/a");
    row("twice", "entry 'resources/a' is there twice");
    row("damaged", "it is damaged");
    row("bomb", "has more than 1024 MiB when it is unpacked");
    row("lying_bomb", "'resources/zeros' is larger than the archive says");
    row("large_description", "has more than 64 MiB");
    row("laughs", "declares or uses entities");
    row("external_entity", "declares or uses entities");
    row("nested", "stand inside of each other");
    row("attributes", "more than 256 attributes");
    row("no_xml", "this is not XML");
    row("cut", "this is not XML");
    row("other_root", "instead of fmiModelDescription");
    row("fmi1", "version '1.0' of FMI");
    row("beta", "version '3.0-beta.2' of FMI");
    row("model_exchange", "offers model exchange only");
    row("needs_tool", "needs the tool that has made it ('tests of QtPLC')");
    row("wrong_library", "is not the name of a library");
    row("double_variable", "variable 'x' is there twice");
    row("no_reference", "variable 'x0' has no name, no valid valueReference");
}

void tst_FmuModel::unusableFilesAreRefusedWithAReason()
{
    QFETCH(QString, text);
    const QStringList before = folders();
    const QString file = pathOf(QStringLiteral("hostile/%1").arg(QTest::currentDataTag()));
    QString error;
    QVERIFY(!FmuModel::open(file, &error));
    QVERIFY2(error.startsWith(file + ": ") && error.contains(text), qPrintable(error));
    QCOMPARE(folders(), before);
    QVERIFY(!QFile::exists("/tmp/evil") && !QFile::exists(QDir::tempPath() + "/evil"));
}

void tst_FmuModel::unusableLibrariesAreRefusedWithAReason_data()
{
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("text");
    QTest::newRow("other platforms") << "hostile/windows"
                                     << "it has libraries for darwin64, win64: export it for Linux";
    QTest::newRow("no platform") << "hostile/no_platform"
                                 << "it has libraries for no platform";
    QTest::newRow("not a library") << "hostile/no_library"
                                   << "its library plant.so cannot be loaded";
    QTest::newRow("other version") << "hostile/wrong_version"
                                   << "of FMI 3.0; export the FMU again";
    QTest::newRow("function is missing") << "without_step"
                                         << "its library lacks fmi2DoStep of FMI 2.0";
    QTest::newRow("library is missing")
        << "without_library"
        << "its library plant.so needs the library libfmu_needed.so, which this computer "
           "does not have";
    QTest::newRow("wrong guid") << "hostile/wrong_guid"
                                << "refuses to be instantiated: 'the guid is {other}, not {9d1a4f0e-plant-2}'";
}

void tst_FmuModel::unusableLibrariesAreRefusedWithAReason()
{
    QFETCH(QString, file);
    QFETCH(QString, text);
    QString error;
    const std::unique_ptr<FmuModel> model = FmuModel::open(pathOf(file), &error);
    QVERIFY2(model, qPrintable(error));
    if (model->load(&error))
        error = thrownBy([&] { model->reset(); });
    QVERIFY2(error.contains(text), qPrintable(error));
}

void tst_FmuModel::foldersAreRemovedAtTheEndAndAfterACrash()
{
    const QStringList before = folders();
    {
        const Plant plant("plant2");
        QVERIFY2(plant.error.isEmpty(), qPrintable(plant.error));
        QCOMPARE(folders().size(), before.size() + 1);
    }
    QCOMPARE(folders(), before);
    // As a process leaves it that is gone: its file is there, and nobody holds it.
    const QString leftover = QDir::tempPath() + "/qtplc-fmu-crash1";
    QVERIFY(QDir().mkpath(leftover + "/resources"));
    QFile lock(leftover + "/.lock");
    QVERIFY(lock.open(QIODevice::WriteOnly));
    lock.close();
    const Plant plant("plant2");
    QVERIFY2(plant.error.isEmpty(), qPrintable(plant.error));
    QVERIFY(!QFile::exists(leftover));
    const Plant other("plant2");  // leaves the folder of the first one alone
    QVERIFY2(other.error.isEmpty(), qPrintable(other.error));
    QCOMPARE(folders().size(), before.size() + 2);
}

QTEST_GUILESS_MAIN(tst_FmuModel)
#include "tst_FmuModel.moc"
