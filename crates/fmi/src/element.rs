//! XML elements, and their text.

use quick_xml::escape::escape;

/// Names and values of attributes.
pub(crate) type Attributes = Vec<(&'static str, String)>;

/// An element: its name, its attributes and what is in it.
#[derive(Debug)]
pub(crate) struct Element {
    name: &'static str,
    attributes: Attributes,
    content: Content,
}

#[derive(Debug)]
enum Content {
    Empty,
    Text(String),
    Elements(Vec<Element>),
}

impl Element {
    /// An empty element without attributes.
    pub fn new(name: &'static str) -> Self {
        Self {
            name,
            attributes: Vec::new(),
            content: Content::Empty,
        }
    }

    /// An element with a text in it.
    pub fn of_text(name: &'static str, text: &str) -> Self {
        Self {
            content: Content::Text(text.to_owned()),
            ..Self::new(name)
        }
    }

    /// Adds an attribute.
    pub fn set(self, name: &'static str, value: impl ToString) -> Self {
        self.set_all([(name, value)])
    }

    /// Adds attributes.
    pub fn set_all<T: ToString>(
        mut self,
        attributes: impl IntoIterator<Item = (&'static str, T)>,
    ) -> Self {
        let attributes = attributes.into_iter();
        self.attributes
            .extend(attributes.map(|(name, value)| (name, value.to_string())));
        self
    }

    /// Adds elements to the content, which even without any has an end tag of its own.
    pub fn with(mut self, elements: impl IntoIterator<Item = Self>) -> Self {
        let mut content = match self.content {
            Content::Elements(content) => content,
            _ => Vec::new(),
        };
        content.extend(elements);
        self.content = Content::Elements(content);
        self
    }

    /// The document with this root.
    pub fn to_document(&self) -> String {
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}",
            self.to_lines(2, 0)
        )
    }

    /// Its lines, each level indented by so many blanks more.
    pub fn to_lines(&self, indent: usize, level: usize) -> String {
        let (name, margin) = (self.name, " ".repeat(indent * level));
        let attributes = self.attributes.iter();
        let attributes = attributes.map(|(name, value)| format!(" {name}=\"{}\"", escape(value)));
        let attributes: String = attributes.collect();
        let content = match &self.content {
            Content::Empty => "/>".to_owned(),
            Content::Text(text) => format!(">{}</{name}>", escape(text)),
            Content::Elements(elements) => {
                let lines = elements.iter().map(|it| it.to_lines(indent, level + 1));
                format!(">\n{}{margin}</{name}>", lines.collect::<String>())
            }
        };
        format!("{margin}<{name}{attributes}{content}\n")
    }
}
