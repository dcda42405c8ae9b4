#include "input/mission/document.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <set>
#include <sstream>
#include <utility>

#include "core/text.h"
#include "input/mission/yaml_faults.h"

namespace sonarsim {

namespace {

constexpr std::size_t deepest = 16;
// A mission of 2,000 sensors, as written into its dataset, has 120,000.
constexpr std::size_t max_nodes = 250'000;

bool is_control(char byte) {
    const auto value = static_cast<unsigned char>(byte);
    return value < 0x20 || value == 0x7f;
}

/// yaml-cpp takes the byte 4 for the end of a file and guesses at encodings: neither may reach it.
void check_characters(std::string_view text, YamlPlace place, Lines lines) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < text.size(); i += length) {
        length = utf8_length(text.substr(i));
        const char c = text[i];
        const bool blank = c == '\t' || c == '\n' || c == '\r';
        if (length > 0 && (blank || !is_control(c))) continue;
        if (lines == Lines::counted) {
            const std::string_view before = text.substr(0, i);
            place.line = static_cast<int>(std::ranges::count(before, '\n')) + 1;
            place.column = static_cast<int>(i - (before.rfind('\n') + 1)) + 1;
        }
        const std::string format(known_format(text));
        if (!format.empty()) refuse(place, "is {}, not YAML", format);
        if (length == 0) refuse(place, "is not UTF-8 text; save the file as UTF-8");
        refuse(place, "control character in the text");
    }
}

/// Builds the tree from the parser's events. It stops the parser at the first thing that a mission
/// may not hold, before the parser's recursion or memory can grow.
class Builder : public YAML::EventHandler {
  public:
    Builder(std::shared_ptr<const std::string> source, Lines lines)
        : source_(std::move(source)), lines_(lines) {
        root_.place = place(YAML::Mark{});
    }

    YamlNode take() { return std::move(root_); }

    /// Throws InputError if the last quoted text is not closed.
    void check_quotes(std::string_view text) const {
        const auto at = static_cast<std::size_t>(last_quote_.pos);
        const bool is_quote = at < text.size() && (text[at] == '"' || text[at] == '\'');
        if (is_quote && !is_closed(text, at))
            refuse(place(last_quote_), "this quote is not closed");
    }

    YamlPlace place(const YAML::Mark& mark) const {
        if (lines_ == Lines::none) return {source_, 0, 0};
        return {source_, mark.line + 1, mark.column + 1};
    }

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (std::exchange(started_, true))
            refuse(place(mark), "a second YAML document; only one is read");
    }
    void OnDocumentEnd() override {}

    void OnNull(const YAML::Mark& mark, YAML::anchor_t) override {
        add(node_at(mark, YamlNode::Kind::empty));
    }

    void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
        refuse(place(mark), "aliases (*name) are not supported; write the value out");
    }

    void OnAnchor(const YAML::Mark& mark, const std::string&) override {
        refuse(place(mark), "anchors (&name) are not supported; write the value out");
    }

    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                  const std::string& value) override {
        check_tag(mark, tag);
        YamlNode scalar = node_at(mark, YamlNode::Kind::scalar);
        scalar.quoted = tag == "!";
        if (scalar.quoted) last_quote_ = mark;
        scalar.text = value;
        add(std::move(scalar));
    }

    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                         YAML::EmitterStyle::value) override {
        open(mark, tag, YamlNode::Kind::list);
    }
    void OnSequenceEnd() override { close(); }

    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                    YAML::EmitterStyle::value) override {
        open(mark, tag, YamlNode::Kind::map);
    }
    void OnMapEnd() override { close(); }

  private:
    /// A list or map that is still open.
    struct Open {
        YamlNode node;
        std::set<std::string> keys;  ///< all keys so far
        YamlNode key;                ///< the key of the next value
        bool key_comes_next = false;
    };

    YamlNode node_at(const YAML::Mark& mark, YamlNode::Kind kind) const {
        YamlNode node;
        node.kind = kind;
        node.place = place(mark);
        return node;
    }

    void check_tag(const YAML::Mark& mark, const std::string& tag) const {
        if (tag != "?" && tag != "!" && !tag.empty())
            refuse(place(mark), "tags (!name) are not supported");
    }

    void open(const YAML::Mark& mark, const std::string& tag, YamlNode::Kind kind) {
        check_tag(mark, tag);
        if (open_.size() == deepest) refuse(place(mark), "nested deeper than {} levels", deepest);
        if (!open_.empty() && open_.back().key_comes_next) {
            // The parser reads an unclosed bracket as the start of a key.
            refuse(place(mark),
                   "a bracket is not closed, or a list or map stands where a key must");
        }
        Open& begun = open_.emplace_back();
        begun.node = node_at(mark, kind);
        begun.key_comes_next = kind == YamlNode::Kind::map;
    }

    void close() {
        YamlNode node = std::move(open_.back().node);
        open_.pop_back();
        add(std::move(node));
    }

    void add(YamlNode node) {
        if (++count_ > max_nodes) {
            refuse(node.place,
                   "more than {} values; long trajectories belong into a file of their own",
                   max_nodes);
        }
        if (open_.empty()) {
            root_ = std::move(node);
            return;
        }
        Open& parent = open_.back();
        if (parent.key_comes_next) {
            add_key(parent, std::move(node));
            return;
        }
        if (parent.node.kind == YamlNode::Kind::map) {
            // For a value that is left out, the parser gives the place of the next key.
            const bool is_left_out = node.kind == YamlNode::Kind::empty;
            if (is_left_out && node.place.line != parent.key.place.line)
                node.place = parent.key.place;
            node.key = std::move(parent.key.text);
            node.key_place = std::move(parent.key.place);
            parent.key_comes_next = true;
        }
        parent.node.items.push_back(std::move(node));
    }

    static void add_key(Open& parent, YamlNode key) {
        if (key.kind != YamlNode::Kind::scalar) refuse(key.place, "a key must be text");
        if (!parent.keys.insert(key.text).second) {
            const int line = parent.node.find(key.text)->key_place.line;
            const std::string first = line > 0 ? fmt::format("; first in line {}", line) : "";
            refuse(key.place, "duplicate key {}{}", in_quotes(key.text), first);
        }
        parent.key = std::move(key);
        parent.key_comes_next = false;
    }

    std::shared_ptr<const std::string> source_;
    Lines lines_;
    bool started_ = false;
    YAML::Mark last_quote_;
    std::size_t count_ = 0;
    std::vector<Open> open_;
    YamlNode root_;
};

}  // namespace

const YamlNode* YamlNode::find(std::string_view wanted) const {
    const auto found = std::ranges::find(items, wanted, &YamlNode::key);
    return kind == Kind::map && found != items.end() ? &*found : nullptr;
}

YamlNode* YamlNode::find(std::string_view wanted) {
    return const_cast<YamlNode*>(std::as_const(*this).find(wanted));
}

void add_missing(const YamlNode& defaults, YamlNode& section) {
    for (const YamlNode& item : defaults.items) {
        YamlNode* const own = section.find(item.key);
        if (own == nullptr) {
            section.items.push_back(item);
        } else if (own->kind == YamlNode::Kind::map && item.kind == YamlNode::Kind::map) {
            add_missing(item, *own);
        }
    }
}

void erase_key(YamlNode& map, std::string_view key) {
    std::erase_if(map.items, [&](const YamlNode& item) { return item.key == key; });
}

void set_place(YamlNode& node, const YamlPlace& place) {
    node.place = place;
    node.key_place = place;
    for (YamlNode& item : node.items)
        set_place(item, place);
}

YamlNode read_document(std::string_view text, const std::string& source, Lines lines) {
    Builder builder(std::make_shared<const std::string>(source), lines);
    text = without_byte_order_mark(text);
    check_characters(text, builder.place(YAML::Mark{}), lines);
    try {
        std::istringstream stream{std::string(text)};
        YAML::Parser parser(stream);
        while (parser.HandleNextDocument(builder)) {
        }
    } catch (const YAML::Exception& error) {
        refuse(builder.place(error.mark), "not valid YAML: {}",
               cause_of(error.msg, error.mark.line, text));
    }
    builder.check_quotes(text);
    return builder.take();
}

std::string shown(std::string_view text, std::size_t longest) {
    const bool cut = text.size() > longest;
    std::size_t end = cut ? longest : text.size();
    while (cut && end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80)
        --end;
    std::string out(text.substr(0, end));
    std::ranges::replace_if(out, is_control, '?');
    return cut ? out + "..." : out;
}

std::string quoted_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

std::string flow_text(const YamlNode& node) {
    if (node.kind == YamlNode::Kind::empty) return "~";
    if (node.kind == YamlNode::Kind::scalar) {
        // Numbers and flags are written as they are, any other text in quotes.
        const bool bare = !node.quoted &&
                          (parse_number(node.text) || node.text == "true" || node.text == "false");
        return bare ? node.text : quoted_text(node.text);
    }
    const bool is_map = node.kind == YamlNode::Kind::map;
    std::string out;
    for (const YamlNode& item : node.items) {
        out += (out.empty() ? "" : ", ") + (is_map ? quoted_text(item.key) + ": " : "") +
               flow_text(item);
    }
    return (is_map ? "{" : "[") + out + (is_map ? "}" : "]");
}

std::string in_quotes(std::string_view text, std::size_t longest) {
    return "'" + shown(text, longest) + "'";
}

}  // namespace sonarsim
