//! XML elements as values, written with indentation.

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesStart, BytesText, Event};
use std::io;

/// An element with attributes in order, and either children or a text.
#[derive(Clone, Debug, Default)]
pub struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Element>,
    text: Option<String>,
}

impl Element {
    /// Creates an empty element.
    pub fn new(name: &'static str) -> Self {
        Self { name, ..Self::default() }
    }

    /// Adds an attribute.
    pub fn with(mut self, key: &'static str, value: impl ToString) -> Self {
        self.attributes.push((key, value.to_string()));
        self
    }

    /// Adds an attribute if there is a value.
    pub fn with_some(self, key: &'static str, value: Option<impl ToString>) -> Self {
        match value {
            Some(value) => self.with(key, value),
            None => self,
        }
    }

    /// Adds a child.
    pub fn child(mut self, child: Element) -> Self {
        self.children.push(child);
        self
    }

    /// Adds children.
    pub fn children(mut self, children: impl IntoIterator<Item = Element>) -> Self {
        self.children.extend(children);
        self
    }

    /// Sets the text inside.
    pub fn text(mut self, text: impl ToString) -> Self {
        self.text = Some(text.to_string());
        self
    }

    fn write(&self, out: &mut Writer<Vec<u8>>) -> io::Result<()> {
        let mut tag = BytesStart::new(self.name);
        for (key, value) in &self.attributes {
            tag.push_attribute((*key, value.as_str()));
        }
        if self.children.is_empty() && self.text.is_none() {
            return out.write_event(Event::Empty(tag));
        }
        out.write_event(Event::Start(tag.borrow()))?;
        if let Some(text) = &self.text {
            out.write_event(Event::Text(BytesText::new(text)))?;
        }
        for child in &self.children {
            child.write(out)?;
        }
        out.write_event(Event::End(tag.to_end()))
    }

    /// The element as an XML document.
    pub fn document(&self) -> io::Result<String> {
        let mut out = Writer::new_with_indent(Vec::new(), b' ', 2);
        out.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        self.finish(out)
    }

    /// The element as an HTML page.
    pub fn page(&self) -> io::Result<String> {
        let mut out = Writer::new_with_indent(Vec::new(), b' ', 1);
        out.write_event(Event::DocType(BytesText::new("html")))?;
        self.finish(out)
    }

    fn finish(&self, mut out: Writer<Vec<u8>>) -> io::Result<String> {
        self.write(&mut out)?;
        let mut text = String::from_utf8(out.into_inner()).map_err(io::Error::other)?;
        text.push('\n');
        Ok(text)
    }
}

#[cfg(test)]
mod tests {
    use super::Element;

    #[test]
    fn an_element_is_indented_and_escaped() {
        let text = Element::new("a").with("b", "1 < 2 & \"3\"").child(Element::new("c").text("<d>")).document();
        let wanted = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
                      <a b=\"1 &lt; 2 &amp; &quot;3&quot;\">\n  <c>&lt;d&gt;</c>\n</a>\n";
        assert_eq!(text.ok().as_deref(), Some(wanted));
    }
}
