// SPDX-License-Identifier: Apache-2.0
#include "JsonNames.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <vector>

namespace qplc {

namespace {

bool isSpace(char character)
{
    return character == ' ' || character == '\t' || character == '\n' || character == '\r';
}

/// A name as it stands in the JSON text, between its quotes.
class RawName
{
public:
    /// \param place  behind the opening quote; is moved behind the closing one
    RawName(const QByteArray &json, int *place)
        : m_begin(json.constData() + *place)
    {
        const int begin = *place;
        const int size = json.size();
        int end = begin;
        for (; end < size && m_begin[end - begin] != '"'; ++end) {
            if (m_begin[end - begin] == '\\') {
                m_hasEscapes = true;
                ++end;
            }
        }
        m_size = std::min(end, size) - begin;
        *place = end + 1;
    }

    bool hasEscapes() const { return m_hasEscapes; }
    QString text() const
    {
        const QByteArray bytes = QByteArray::fromRawData(m_begin, m_size);
        return m_hasEscapes ? unescaped(bytes) : QString::fromUtf8(bytes);
    }
    /// Of bytes, in any order that tells them apart.
    bool operator<(const RawName &other) const
    {
        return m_size != other.m_size ? m_size < other.m_size
                                      : std::memcmp(m_begin, other.m_begin, std::size_t(m_size)) < 0;
    }
    bool operator==(const RawName &other) const
    {
        return m_size == other.m_size && std::memcmp(m_begin, other.m_begin, std::size_t(m_size)) == 0;
    }

private:
    static QString unescaped(const QByteArray &bytes)
    {
        QString result;
        int from = 0;
        for (int escape = 0; (escape = bytes.indexOf('\\', from)) >= 0;) {
            result += QString::fromUtf8(bytes.mid(from, escape - from));
            const char code = bytes.at(escape + 1);  // there is one: the last quote of a name is not escaped
            if (code == 'u')
                result += QChar(bytes.mid(escape + 2, 4).toUShort(nullptr, 16));
            else
                result += character(code);
            from = escape + (code == 'u' ? 6 : 2);
        }
        return result + QString::fromUtf8(bytes.mid(from));
    }

    static QChar character(char code)
    {
        switch (code) {
        case 'b':
            return QLatin1Char('\b');
        case 'f':
            return QLatin1Char('\f');
        case 'n':
            return QLatin1Char('\n');
        case 'r':
            return QLatin1Char('\r');
        case 't':
            return QLatin1Char('\t');
        default:
            return QLatin1Char(code);  // also where JSON knows no such escape: so does Qt
        }
    }

    const char *m_begin;
    int m_size = 0;
    bool m_hasEscapes = false;
};

/// Of the names from \a begin to \a end, which it sorts.
template<typename Iterator>
Iterator doubledAmong(Iterator begin, Iterator end)
{
    std::sort(begin, end);
    return std::adjacent_find(begin, end);
}

std::optional<QString> doubledOf(std::vector<RawName>::iterator begin, std::vector<RawName>::iterator end)
{
    if (std::none_of(begin, end, [](const RawName &name) { return name.hasEscapes(); })) {
        const auto found = doubledAmong(begin, end);
        return found == end ? std::nullopt : std::optional<QString>(found->text());
    }
    std::vector<QString> texts;  // the same name may be written in several ways
    std::transform(begin, end, std::back_inserter(texts), [](const RawName &name) { return name.text(); });
    const auto found = doubledAmong(texts.begin(), texts.end());
    return found == texts.end() ? std::nullopt : std::optional<QString>(*found);
}

}  // namespace

std::optional<QString> doubledJsonName(const QByteArray &json)
{
    std::vector<RawName> names;        // of the objects around the place, those of the innermost last
    std::vector<std::ptrdiff_t> open;  // where the names of each object (arrays: none) begin
    for (int place = 0; place < json.size();) {
        const char character = json.at(place++);
        if (character == '{' || character == '[') {
            open.push_back(std::ptrdiff_t(names.size()));
        } else if ((character == '}' || character == ']') && !open.empty()) {
            const auto begin = names.begin() + open.back();
            if (const std::optional<QString> doubled = doubledOf(begin, names.end()))
                return doubled;
            names.erase(begin, names.end());
            open.pop_back();
        } else if (character == '"') {
            const RawName text(json, &place);
            while (place < json.size() && isSpace(json.at(place)))
                ++place;
            if (place < json.size() && json.at(place) == ':' && !open.empty())
                names.push_back(text);
        }
    }
    return std::nullopt;
}

}  // namespace qplc
