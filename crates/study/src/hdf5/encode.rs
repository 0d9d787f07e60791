//! Object headers and what stands in them: types, shapes, layouts, attributes; and the heap of what
//! has no fixed length.

use super::{Attribute, Dataset, Kind, Object, misuse};
use std::collections::HashMap;
use std::io;

/// Level of compression: the usual compromise of time and size.
pub(super) const DEFLATE_LEVEL: u32 = 6;
/// An address that is none.
pub(super) const NOWHERE: u64 = u64::MAX;

/// Element of a dataset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Type {
    Single,
    Double,
    Integer,
}

impl Type {
    /// Bytes of an element.
    pub(super) fn size(self) -> usize {
        match self {
            Self::Single => 4,
            Self::Double | Self::Integer => 8,
        }
    }

    /// Its datatype message.
    fn bytes(self) -> Vec<u8> {
        match self {
            // Sign at bit 31, exponent 8 bits from 23, bias 127.
            Self::Single => float([0x20, 31, 0], 4, 32, [23, 8, 0, 23], 127),
            // Sign at bit 63, exponent 11 bits from 52, bias 1023.
            Self::Double => float([0x20, 63, 0], 8, 64, [52, 11, 0, 52], 1023),
            Self::Integer => integer(true, 8),
        }
    }
}

fn float(bits: [u8; 3], size: u32, precision: u16, parts: [u8; 4], bias: u32) -> Vec<u8> {
    let mut bytes = class(1, bits, size);
    bytes.extend(0_u16.to_le_bytes());
    bytes.extend(precision.to_le_bytes());
    bytes.extend(parts);
    bytes.extend(bias.to_le_bytes());
    bytes
}

fn integer(is_signed: bool, size: u32) -> Vec<u8> {
    let mut bytes = class(0, [if is_signed { 8 } else { 0 }, 0, 0], size);
    bytes.extend(0_u16.to_le_bytes());
    bytes.extend((8 * size as u16).to_le_bytes());
    bytes
}

/// Start of a datatype message, version 1.
fn class(class: u8, bits: [u8; 3], size: u32) -> Vec<u8> {
    let mut bytes = vec![0x10 | class, bits[0], bits[1], bits[2]];
    bytes.extend(size.to_le_bytes());
    bytes
}

/// Text of any length, UTF-8, in the heap.
fn text_type() -> Vec<u8> {
    let mut bytes = class(9, [1, 1, 0], HEAP_ITEM as u32);
    bytes.extend(integer(false, 1));
    bytes
}

/// Text of fixed length, ASCII, ended by a zero: what dimension scales demand of their class.
fn fixed_text_type(length: usize) -> Vec<u8> {
    class(3, [0, 0, 0], length as u32)
}

fn reference_type() -> Vec<u8> {
    class(7, [0; 3], 8)
}

/// Lists of references in the heap.
fn reference_list_type() -> Vec<u8> {
    let mut bytes = class(9, [0; 3], HEAP_ITEM as u32);
    bytes.extend(reference_type());
    bytes
}

/// A dataset and its dimension.
fn scale_use_type() -> Vec<u8> {
    let mut bytes = class(6, [2, 0, 0], 16);
    for (name, offset, kind) in [
        ("dataset", 0_u32, reference_type()),
        ("dimension", 8, integer(true, 4)),
    ] {
        bytes.extend(padded(&terminated(name)));
        bytes.extend(offset.to_le_bytes());
        bytes.extend([0; 28]); // no array
        bytes.extend(kind);
    }
    bytes
}

/// Where the data of a dataset are.
#[derive(Debug)]
pub(super) enum Layout {
    Contiguous { address: u64, size: u64 },
    Chunked { address: u64, dims: Vec<u32> },
}

/// The object header: its messages. Addresses of headers are those of `headers`; while these are
/// being planned any will do.
pub(super) fn header(
    objects: &[Object],
    index: usize,
    headers: &[u64],
    table: [u64; 2],
    heap: &Heap,
) -> io::Result<Vec<u8>> {
    let object = &objects[index];
    let mut messages = Messages::default();
    match &object.kind {
        Kind::Group(_) => messages.add(
            0x11,
            &[table[0].to_le_bytes(), table[1].to_le_bytes()].concat(),
        )?,
        Kind::Dataset(dataset) => describe(dataset, headers, heap, index, &mut messages)?,
    }
    for (place, (name, value)) in object.attributes.iter().enumerate() {
        let items = || heap.items(Owner::Attribute(index, place));
        match value {
            Attribute::Text(text) if is_scale_word(name) => {
                let bytes = terminated(text);
                messages.attribute(name, &fixed_text_type(bytes.len()), &[], &bytes)?;
            }
            Attribute::Text(_) => messages.attribute(name, &text_type(), &[], &items())?,
            Attribute::Texts(list) => {
                messages.attribute(name, &text_type(), &[list.len() as u64], &items())?;
            }
            Attribute::Number(value) => {
                messages.attribute(name, &Type::Double.bytes(), &[], &value.to_le_bytes())?;
            }
            Attribute::Integer(value) => {
                messages.attribute(name, &Type::Integer.bytes(), &[], &value.to_le_bytes())?;
            }
        }
    }
    Ok(messages.finish())
}

/// Attributes of dimension scales, which readers want as text of fixed length.
fn is_scale_word(name: &str) -> bool {
    matches!(name, "CLASS" | "NAME")
}

fn describe(
    dataset: &Dataset,
    headers: &[u64],
    heap: &Heap,
    index: usize,
    messages: &mut Messages,
) -> io::Result<()> {
    messages.add(0x01, &dataspace(&dataset.shape))?;
    messages.add(0x03, &dataset.kind.bytes())?;
    // Default fill value, written where space is allocated: late, or chunk by chunk.
    let allocation = match dataset.layout {
        Layout::Contiguous { .. } => 2,
        Layout::Chunked { .. } => 3,
    };
    messages.add(0x05, &[2, allocation, 2, 1, 0, 0, 0, 0])?;
    match &dataset.layout {
        Layout::Contiguous { address, size } => {
            let mut layout = vec![3, 1];
            layout.extend(address.to_le_bytes());
            layout.extend(size.to_le_bytes());
            messages.add(0x08, &layout)?;
        }
        Layout::Chunked { address, dims } => {
            let mut layout = vec![3, 2, dims.len() as u8 + 1];
            layout.extend(address.to_le_bytes());
            let element = dataset.kind.size() as u32;
            layout.extend(dims.iter().chain([&element]).flat_map(|n| n.to_le_bytes()));
            messages.add(0x0b, &filters(element))?;
            messages.add(0x08, &layout)?;
        }
    }
    if dataset.scales.iter().any(Option::is_some) {
        let items = heap.items(Owner::Scales(index));
        let shape = [dataset.scales.len() as u64];
        messages.attribute("DIMENSION_LIST", &reference_list_type(), &shape, &items)?;
    }
    if !dataset.scale_of.is_empty() {
        let uses = dataset.scale_of.iter().flat_map(|(user, dimension)| {
            let mut bytes = headers[*user].to_le_bytes().to_vec();
            bytes.extend(dimension.to_le_bytes());
            bytes.extend([0; 4]);
            bytes
        });
        let uses: Vec<u8> = uses.collect();
        let shape = [dataset.scale_of.len() as u64];
        messages.attribute("REFERENCE_LIST", &scale_use_type(), &shape, &uses)?;
    }
    Ok(())
}

/// Shuffle and deflate.
fn filters(element: u32) -> Vec<u8> {
    let mut bytes = vec![1, 2, 0, 0, 0, 0, 0, 0];
    for (filter, value) in [(2_u16, element), (1, DEFLATE_LEVEL)] {
        bytes.extend(filter.to_le_bytes());
        bytes.extend([0, 0, 0, 0, 1, 0]); // no name, not optional, one value
        bytes.extend(value.to_le_bytes());
        bytes.extend([0; 4]);
    }
    bytes
}

/// A shape; an empty one is a scalar.
fn dataspace(shape: &[u64]) -> Vec<u8> {
    let mut bytes = vec![1, shape.len() as u8, 0, 0, 0, 0, 0, 0];
    bytes.extend(shape.iter().flat_map(|n| n.to_le_bytes()));
    bytes
}

/// The messages of one object header.
#[derive(Default)]
struct Messages {
    count: u16,
    bytes: Vec<u8>,
}

impl Messages {
    fn add(&mut self, kind: u16, content: &[u8]) -> io::Result<()> {
        let content = padded(content);
        let size = u16::try_from(content.len())
            .map_err(|_| misuse("an attribute is larger than 64 kB".to_owned()))?;
        self.count += 1;
        self.bytes.extend(kind.to_le_bytes());
        self.bytes.extend(size.to_le_bytes());
        self.bytes.extend([0; 4]);
        self.bytes.extend(content);
        Ok(())
    }

    fn attribute(&mut self, name: &str, kind: &[u8], shape: &[u64], data: &[u8]) -> io::Result<()> {
        let (name, space) = (terminated(name), dataspace(shape));
        let mut bytes = vec![1, 0];
        for part in [name.as_slice(), kind, &space] {
            bytes.extend((part.len() as u16).to_le_bytes());
        }
        for part in [name.as_slice(), kind, &space] {
            bytes.extend(padded(part));
        }
        bytes.extend(data);
        self.add(0x0c, &bytes)
    }

    fn finish(self) -> Vec<u8> {
        let mut header = vec![1, 0];
        header.extend(self.count.to_le_bytes());
        header.extend(1_u32.to_le_bytes());
        header.extend((self.bytes.len() as u32).to_le_bytes());
        header.extend([0; 4]);
        header.extend(self.bytes);
        header
    }
}

/// Whose items in the heap.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Owner {
    /// Attribute of an object, by its place.
    Attribute(usize, usize),
    /// The scales of a dataset.
    Scales(usize),
}

/// Bytes of a pointer into the heap: length, address, index.
const HEAP_ITEM: usize = 16;

/// What has no fixed length: texts, and lists of scales.
pub(super) struct Heap {
    address: u64,
    entries: Vec<Entry>,
    /// First entry and their number.
    owners: HashMap<Owner, (usize, usize)>,
}

enum Entry {
    Text(String),
    /// One reference to the header of an object, or none.
    Reference(Option<usize>),
}

impl Entry {
    fn len(&self) -> usize {
        match self {
            Self::Text(text) => text.len(),
            Self::Reference(Some(_)) => 8,
            Self::Reference(None) => 0,
        }
    }
}

impl Heap {
    /// Collects what the objects hold, to stand at `address`.
    pub(super) fn of(objects: &[Object], address: u64) -> io::Result<Self> {
        let mut heap = Self {
            address,
            entries: Vec::new(),
            owners: HashMap::new(),
        };
        for (index, object) in objects.iter().enumerate() {
            for (place, (name, value)) in object.attributes.iter().enumerate() {
                let texts = match value {
                    Attribute::Text(text) if !is_scale_word(name) => std::slice::from_ref(text),
                    Attribute::Texts(list) => list,
                    _ => continue,
                };
                let texts = texts.iter().cloned().map(Entry::Text);
                heap.own(Owner::Attribute(index, place), texts);
            }
            if let Kind::Dataset(dataset) = &object.kind {
                let scales = dataset.scales.iter().copied().map(Entry::Reference);
                heap.own(Owner::Scales(index), scales);
            }
        }
        if heap.entries.len() >= usize::from(u16::MAX) {
            return Err(misuse("too many texts".to_owned()));
        }
        Ok(heap)
    }

    fn own(&mut self, owner: Owner, entries: impl Iterator<Item = Entry>) {
        let first = self.entries.len();
        self.entries.extend(entries);
        self.owners
            .insert(owner, (first, self.entries.len() - first));
    }

    pub(super) fn address(&self) -> u64 {
        self.address
    }

    /// Pointers to the items of an owner. What is empty points nowhere.
    fn items(&self, owner: Owner) -> Vec<u8> {
        let (first, count) = self.owners.get(&owner).copied().unwrap_or_default();
        let item = |place: usize| {
            let entry = &self.entries[place];
            let length = match entry {
                Entry::Text(text) => text.len() as u32,
                Entry::Reference(scale) => u32::from(scale.is_some()),
            };
            let (address, index) = match length {
                0 => (0, 0),
                _ => (self.address, place as u32 + 1),
            };
            let mut bytes = length.to_le_bytes().to_vec();
            bytes.extend(address.to_le_bytes());
            bytes.extend(index.to_le_bytes());
            bytes
        };
        (first..first + count).flat_map(item).collect()
    }

    /// The heap as one collection; headers that are not known yet stand as 0.
    pub(super) fn bytes(&self, headers: &[u64]) -> Vec<u8> {
        /// Readers take no smaller collection.
        const SMALLEST: usize = 4096;
        let mut body = Vec::new();
        for (place, entry) in self.entries.iter().enumerate() {
            let content = match entry {
                Entry::Text(text) => text.as_bytes().to_vec(),
                Entry::Reference(None) => Vec::new(),
                Entry::Reference(Some(object)) => {
                    let address = headers.get(*object).copied().unwrap_or_default();
                    address.to_le_bytes().to_vec()
                }
            };
            if entry.len() > 0 {
                body.extend((place as u16 + 1).to_le_bytes());
                body.extend([1, 0, 0, 0, 0, 0]); // one user
                body.extend((content.len() as u64).to_le_bytes());
                body.extend(padded(&content));
            }
        }
        // What is left over is the free object 0, whose size counts its own head.
        const HEADS: usize = 16 + 16;
        let size = (body.len() + HEADS).max(SMALLEST);
        let mut bytes = b"GCOL\x01\0\0\0".to_vec();
        bytes.extend((size as u64).to_le_bytes());
        let free = size - 16 - body.len();
        bytes.extend(body);
        bytes.extend([0; 8]);
        bytes.extend((free as u64).to_le_bytes());
        bytes.resize(size, 0);
        bytes
    }
}

/// ASCII with a zero at its end.
pub(super) fn terminated(text: &str) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    bytes.push(0);
    bytes
}

/// Filled with zeros to a multiple of 8.
pub(super) fn padded(bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}
