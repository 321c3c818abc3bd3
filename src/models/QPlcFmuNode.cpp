// SPDX-License-Identifier: Apache-2.0
#include "QPlcFmuNode.h"

#include "FmuConfiguration.h"
#include "FmuModel.h"
#include "FmuPort.h"
#include "FmuWiring.h"
#include "ModelsLogging.h"
#include "signals/DurationText.h"
#include "signals/IniParser.h"
#include "signals/MessageText.h"

#include <QtCore/QTimer>

#include <algorithm>
#include <atomic>
#include <stdexcept>

using qplc::ConfigurationEntry;
using qplc::ConfigurationTerm;
using qplc::FmuConfiguration;
using qplc::FmuElement;
using qplc::FmuModel;
using qplc::FmuPort;
using qplc::FmuVariable;

namespace {

constexpr qint64 largestConfiguration = 4 * 1024 * 1024;  // [byte]
constexpr int logInterval = 100;                          // [ms]

}  // namespace

struct QPlcFmuNode::Private
{
    explicit Private(QPlcFmuNode *node)
        : q(node)
    {
    }

    bool configure(FmuConfiguration *configuration);
    void open(FmuConfiguration *configuration);
    void build(FmuConfiguration *configuration);
    void buildRead(FmuConfiguration *configuration, const ConfigurationEntry &entry);
    void buildWrite(FmuConfiguration *configuration, const ConfigurationEntry &entry);
    bool find(FmuConfiguration *configuration, const ConfigurationEntry &entry, const QString &name,
              QVector<FmuElement> *elements) const;
    bool findTerm(FmuConfiguration *configuration, const ConfigurationEntry &entry, ConfigurationTerm *term,
                  QVector<FmuElement> *elements) const;
    void connect(FmuConfiguration *configuration, const ConfigurationEntry &entry, const ConfigurationTerm &signal,
                 const QVector<FmuElement> &elements, QPlcPort::Direction direction, double factor, double offset);
    FmuPort *port(const QString &signal, QPlcPort::Direction direction);
    void connectByName(const QPlcSignalTable &table);
    void setPeriod(std::chrono::nanoseconds period);
    void printLog();

    QPlcFmuNode *q;
    QVector<QPlcParseError> errors;
    std::unique_ptr<FmuModel> model;
    std::unique_ptr<qplc::FmuWiring> wiring;
    std::vector<std::unique_ptr<FmuPort>> ports;  // destroyed before the model
    bool hasWires = false;
    std::chrono::nanoseconds step{0};       // as configured; 0: the period
    std::chrono::nanoseconds period{0};     // of this phase
    std::chrono::nanoseconds phaseStep{0};  // in this phase
    qint64 steps = 0;                       // of a cycle
    std::atomic<bool> hasEnded{false};      // and nobody was told
    bool isTold = false;                    // that it has ended, in this phase
    QTimer timer;
};

// ---- configuration ----

QPlcFmuNode::QPlcFmuNode(const QString &name, QObject *parent)
    : QPlcCompactSlaveNode(name, ErrorZeroOrderHold, parent)
    , m_fmu(std::make_unique<Private>(this))
{
    setTwoPhase(true);
    connect(&m_fmu->timer, &QTimer::timeout, this, [this] { m_fmu->printLog(); });
}

QPlcFmuNode::~QPlcFmuNode()
{
    disconnectFromMaster();
    m_fmu->ports.clear();
    if (m_fmu->model)
        m_fmu->printLog();
}

bool QPlcFmuNode::configureFromFile(const QString &fileName)
{
    if (fileName.endsWith(QLatin1String(".fmu"), Qt::CaseInsensitive)) {
        FmuConfiguration configuration(fileName);
        return m_fmu->configure(&configuration);
    }
    QByteArray text;
    m_fmu->errors.clear();
    return qplc::IniParser::readFile(fileName, QStringLiteral("the configuration of an FMU node"), largestConfiguration,
                                     &text, &m_fmu->errors)
        && configure(text, fileName);
}

bool QPlcFmuNode::configure(const QByteArray &text, const QString &fileName)
{
    FmuConfiguration configuration(text, fileName);
    return m_fmu->configure(&configuration);
}

bool QPlcFmuNode::Private::configure(FmuConfiguration *configuration)
{
    Q_ASSERT_X(!model, "QPlcFmuNode::configure", "a node is configured once");
    if (!configuration->fmuEntry().value.isEmpty())
        open(configuration);
    if (wiring)
        build(configuration);
    errors = configuration->errors();
    if (!errors.isEmpty()) {
        ports.clear();
        wiring.reset();
        model.reset();
        return false;
    }
    if (!configuration->nodeName().isEmpty())
        q->setName(configuration->nodeName());
    else if (q->name().isEmpty())
        q->setName(model->description().modelName);
    timer.start(logInterval);
    return true;
}

void QPlcFmuNode::Private::open(FmuConfiguration *configuration)
{
    QString error;
    model = FmuModel::open(configuration->fmuName(), &error);
    if (!model || !model->load(&error)) {
        configuration->addError(configuration->fmuEntry(), error);
        return;
    }
    wiring = std::make_unique<qplc::FmuWiring>(model->description());
    FmuModel::Settings settings;
    settings.tolerance = configuration->tolerance();
    settings.logs = configuration->logs();
    for (const ConfigurationEntry &entry : configuration->starts()) {
        FmuModel::Start start;
        if (FmuModel::readStart(model->description(), entry.key, entry.value, &start, &error))
            settings.starts.append(start);
        else
            configuration->addError(entry, error);
    }
    model->setSettings(settings);
    step = configuration->step();
    hasWires = configuration->hasWires();
}

void QPlcFmuNode::Private::build(FmuConfiguration *configuration)
{
    for (const ConfigurationEntry &entry : configuration->reads())
        buildRead(configuration, entry);
    for (const ConfigurationEntry &entry : configuration->writes())
        buildWrite(configuration, entry);
    for (const std::unique_ptr<FmuPort> &port : ports) {
        const QString missing = port->isInput() ? QString() : port->missingElements();
        if (!missing.isEmpty())
            configuration->addError(
                {}, QStringLiteral("no variable gives a value to %1; add it to [fmu.read]").arg(missing));
    }
}

/// signal = variable * factor + offset
void QPlcFmuNode::Private::buildRead(FmuConfiguration *configuration, const ConfigurationEntry &entry)
{
    ConfigurationTerm signal;
    ConfigurationTerm source;
    QVector<FmuElement> elements;
    QString error;
    if (!ConfigurationTerm::fromText(entry.key, &signal, &error))
        configuration->addError(entry, error);
    else if (signal.factor != 1.0 || signal.offset != 0.0)
        configuration->addError(
            entry,
            QStringLiteral("factor and offset of %1 belong to the right side of '='").arg(qplc::quoted(entry.key)));
    else if (findTerm(configuration, entry, &source, &elements))
        connect(configuration, entry, signal, elements, QPlcPort::Output, source.factor, source.offset);
}

/// variable = signal * factor + offset
void QPlcFmuNode::Private::buildWrite(FmuConfiguration *configuration, const ConfigurationEntry &entry)
{
    ConfigurationTerm signal;
    QVector<FmuElement> elements;
    QString error;
    double number = 0.0;
    if (!find(configuration, entry, entry.key, &elements))
        return;
    const FmuVariable &variable = *elements.first().variable;
    if (!variable.isSettable())
        configuration->addError(entry,
                                QStringLiteral("%1 (%2) cannot be written while cycles run; inputs and tunable "
                                               "parameters can")
                                    .arg(qplc::quoted(variable.name), variable.causalityText()));
    else if (qplc::finiteNumberFromText(entry.value, &number))
        configuration->addError(
            entry,
            QStringLiteral("%1 is a number and not a signal; set it in [fmu.start]").arg(qplc::quoted(entry.value)));
    else if (!ConfigurationTerm::fromText(entry.value, &signal, &error))
        configuration->addError(entry, error);
    else
        connect(configuration, entry, signal, elements, QPlcPort::Input, signal.factor, signal.offset);
}

bool QPlcFmuNode::Private::find(FmuConfiguration *configuration, const ConfigurationEntry &entry, const QString &name,
                                QVector<FmuElement> *elements) const
{
    QString error;
    *elements = wiring->find(name, &error);
    if (elements->isEmpty())
        configuration->addError(entry, error);
    return !elements->isEmpty();
}

/// The whole text may be the name of a variable, with characters that a term does not have.
bool QPlcFmuNode::Private::findTerm(FmuConfiguration *configuration, const ConfigurationEntry &entry,
                                    ConfigurationTerm *term, QVector<FmuElement> *elements) const
{
    QString error;
    if (model->description().find(entry.value))
        return find(configuration, entry, entry.value, elements);
    if (!ConfigurationTerm::fromText(entry.value, term, &error)) {
        configuration->addError(entry, error);
        return false;
    }
    const QString name = term->element < 0 ? term->name : QStringLiteral("%1[%2]").arg(term->name).arg(term->element);
    return find(configuration, entry, name, elements);
}

void QPlcFmuNode::Private::connect(FmuConfiguration *configuration, const ConfigurationEntry &entry,
                                   const ConfigurationTerm &signal, const QVector<FmuElement> &elements,
                                   QPlcPort::Direction direction, double factor, double offset)
{
    if (signal.element >= 0 && elements.size() > 1) {
        configuration->addError(entry,
                                QStringLiteral("an element of a signal cannot have %1 values; leave the brackets out")
                                    .arg(elements.size()));
        return;
    }
    const bool isArray = signal.element >= 0 || elements.size() > 1;
    FmuPort *target = port(signal.name, direction);
    for (int i = 0; i < elements.size(); ++i) {
        if (!target->add({elements.at(i), factor, offset, std::max(signal.element, 0) + i}, isArray)) {
            configuration->addError(
                entry,
                QStringLiteral("%1 is wired twice, or with brackets and without; wire each element once")
                    .arg(qplc::quoted(signal.name)));
            return;
        }
    }
}

FmuPort *QPlcFmuNode::Private::port(const QString &signal, QPlcPort::Direction direction)
{
    const auto found = std::find_if(ports.begin(), ports.end(), [&](const std::unique_ptr<FmuPort> &other) {
        return other->name() == signal && other->direction() == direction;
    });
    if (found != ports.end())
        return found->get();
    ports.push_back(std::make_unique<FmuPort>(q, signal, direction, model->description().version,
                                              direction == QPlcPort::Input ? &model->inputs() : &model->outputs()));
    return ports.back().get();
}

QVector<QPlcParseError> QPlcFmuNode::configurationErrors() const
{
    return m_fmu->errors;
}

QString QPlcFmuNode::modelName() const
{
    return m_fmu->model ? m_fmu->model->description().modelName : QString();
}

QString QPlcFmuNode::fmiVersion() const
{
    return m_fmu->model ? m_fmu->model->description().versionText : QString();
}

QVector<QPlcFmuNode::Wire> QPlcFmuNode::wires() const
{
    QVector<Wire> wires;
    for (const std::unique_ptr<FmuPort> &port : m_fmu->ports) {
        for (const FmuPort::Wire &wire : port->wires()) {
            const FmuVariable &variable = *wire.number.variable;
            wires.append({port->elementName(wire.element),
                          variable.count == 1 ? variable.name
                                              : QStringLiteral("%1[%2]").arg(variable.name).arg(wire.number.element),
                          port->direction(), wire.factor, wire.offset});
        }
    }
    return wires;
}

// ---- registration ----

void QPlcFmuNode::declarePorts(const QPlcSignalTable &table)
{
    if (m_fmu->model && !m_fmu->hasWires)
        m_fmu->connectByName(table);
}

void QPlcFmuNode::Private::connectByName(const QPlcSignalTable &table)
{
    ports.clear();
    model->inputs().clear();
    model->outputs().clear();
    QStringList names;
    for (const QString &name : wiring->names()) {
        QString error;
        const QVector<FmuElement> elements = wiring->find(name, &error);
        const FmuVariable::Causality causality = elements.first().variable->causality;
        if (causality != FmuVariable::Input && causality != FmuVariable::Output)
            continue;
        names << name;
        if (!table.contains(name))
            continue;
        FmuPort *target = port(name, causality == FmuVariable::Input ? QPlcPort::Input : QPlcPort::Output);
        for (int i = 0; i < elements.size(); ++i)
            target->add({elements.at(i), 1.0, 0.0, i}, elements.size() > 1);
    }
    if (ports.empty())
        throw std::runtime_error(
            QStringLiteral("no input or output of the FMU is named as a signal; wire them in [fmu.read] and "
                           "[fmu.write] of the node%1")
                .arg(qplc::knownAre(names))
                .toStdString());
}

// ---- cycles ----

void QPlcFmuNode::reset()
{
    if (!m_fmu->model)
        throw std::runtime_error("the node has no FMU; call configure() first");
    m_fmu->period = std::chrono::nanoseconds(0);
    m_fmu->isTold = false;
    m_fmu->model->reset();
}

void QPlcFmuNode::initialized()
{
    m_fmu->model->initialize();
}

void QPlcFmuNode::outputs()
{
    if (!m_fmu->model->isOver())
        m_fmu->model->readOutputs();
}

void QPlcFmuNode::update(const QPlcCycle &cycle)
{
    Private &fmu = *m_fmu;
    if (cycle.period() != fmu.period)
        fmu.setPeriod(cycle.period());
    fmu.model->writeInputs();
    for (qint64 i = 0; i < fmu.steps; ++i)
        fmu.model->doStep();
    if (!fmu.model->isOver())
        return;
    requestSafeStop();
    if (!fmu.isTold)
        fmu.hasEnded.store(true, std::memory_order_release);
    fmu.isTold = true;
}

void QPlcFmuNode::Private::setPeriod(std::chrono::nanoseconds given)
{
    phaseStep = step.count() == 0 ? given : step;
    steps = given / phaseStep;
    if (steps == 0 || steps * phaseStep != given)
        throw std::runtime_error(
            QStringLiteral("the step of the FMU, %1, does not divide the period of the master, %2; "
                           "change 'step' of [fmu]")
                .arg(qplc::durationText(phaseStep), qplc::durationText(given))
                .toStdString());
    model->setStep(double(phaseStep.count()) / 1e9);
    period = given;
}

void QPlcFmuNode::stopped()
{
    m_fmu->model->end();
    m_fmu->printLog();
}

/// What the FMU has reported, and that it has ended: in the thread of the object.
void QPlcFmuNode::Private::printLog()
{
    qplc::FmuLog::Line line;
    qplc::FmuLog &log = model->log();
    while (log.take(&line)) {
        const QString text = QStringLiteral("%1: FMU: %2").arg(q->name(), qplc::FmuLog::textOf(line));
        if (line.status == qplc::fmi::Ok)
            qCInfo(lcModels).noquote() << text;
        else
            qCWarning(lcModels).noquote() << text;
    }
    if (const quint64 lost = log.takeLost())
        qCWarning(lcModels).noquote()
            << QStringLiteral("%1: FMU: %2 lines were too many and are missing").arg(q->name()).arg(lost);
    if (hasEnded.exchange(false, std::memory_order_acquire)) {
        const QString reason = model->overText();
        qCWarning(lcModels).noquote()
            << QStringLiteral("%1: %2; the plant is asked to stop safely").arg(q->name(), reason);
        Q_EMIT q->modelEnded(reason);
    }
}
